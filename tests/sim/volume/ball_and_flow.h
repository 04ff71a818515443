// A ball and a film of liquid in a tank, flows around them, and sums over a volume deficit.
#pragma once

#include "sim/surface/level_set.h"
#include "tests/sim/velocity/velocity_field.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace fluidtex::sim {

inline constexpr int kCells = 32;
inline constexpr double kVoxel = 1.0 / kCells;

// A ball of radius 0.2, and a film below it on the floor, thinner than a cell.
inline double ball(const Vec3d& x) {
  return (x - Vec3d(0.5)).length() - 0.2;
}

inline double ballAndFilm(const Vec3d& x) {
  return std::min(ball(x), x[2] - 0.6 * kVoxel);
}

inline FloatGrid::Ptr phiOf(const std::function<double(const Vec3d&)>& distance) {
  const auto phi = makePhi(kVoxel, 6 * kVoxel);
  unite(*phi, distance, firstCells(Coord(kCells)));
  trimBand(*phi, *makePhi(kVoxel, 3 * kVoxel));
  return phi;
}

inline SolidField box() {
  Options options;
  options.size = Vec3d(1.0);
  options.resolution = kCells;
  return *Solids(options).at(0.0);
}

inline Velocity flow(const std::function<Vec3d(const Vec3d&)>& field) {
  FloatTree topology(0.0f);
  for (int i = -8; i < kCells + 8; i += 8)
    for (int j = -8; j < kCells + 8; j += 8)
      for (int k = -8; k < kCells + 8; k += 8) topology.touchLeaf(Coord(i, j, k))->setValuesOn();
  return velocityField(kVoxel, topology, field);
}

inline double sumOf(const FloatGrid& deficit) {
  double sum = 0.0;
  for (auto it = deficit.cbeginValueOn(); it; ++it) sum += double(*it) * kVoxel * kVoxel * kVoxel;
  return sum;
}

inline double largestOf(const FloatGrid& deficit) {
  float largest = 0.0f;
  for (auto it = deficit.cbeginValueOn(); it; ++it) largest = std::max(largest, std::abs(*it));
  return largest;
}

}  // namespace fluidtex::sim
