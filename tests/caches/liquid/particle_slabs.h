// Places of particles in order and in disorder.
#pragma once

#include "tests/caches/liquid/flows.h"

#include <openvdb/Types.h>

#include <random>
#include <vector>

namespace fluidtex::caches {

inline std::vector<openvdb::Vec3f> floats(const std::vector<Vec3d>& points) {
  return {points.begin(), points.end()};
}

// Each off its place by up to half of `share` spacings along each axis.
inline std::vector<Vec3d> jittered(std::vector<Vec3d> points, double spacing, double share) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.5 * share * spacing, 0.5 * share * spacing);
  for (Vec3d& x : points) x += Vec3d(off(random), off(random), off(random));
  return points;
}

// A slab of 40 x 24 x `layers` particles.
inline std::vector<Vec3d> slab(double spacing, int layers) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 24; ++j)
      for (int k = 0; k < layers; ++k) points.push_back(Vec3d(3, -2, 1) + spacing * Vec3d(i, j, k));
  return points;
}

}  // namespace fluidtex::caches
