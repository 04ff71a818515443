// Levels, carried values and measures for tests of orientation fields.
#pragma once

#include "tests/texture/mesh/closed_meshes.h"
#include "texture/orientation/orient.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace fluidtex::testing {

constexpr double kDegree = std::numbers::pi / 180.0;

inline texture::Surface levelsOf(std::vector<SurfaceMesh> meshes) {
  texture::Surface surface;
  surface.levels = std::move(meshes);
  return surface;
}

inline texture::Surface sphereLevels() {
  return levelsOf({sphereMesh(24), sphereMesh(12), sphereMesh(6)});
}

// Carried onto the same surface: nothing has moved.
inline texture::Carried carriedFrom(const SurfaceMesh& mesh, float trust = 1.0f) {
  texture::Carried carried;
  carried.orientation = mesh.orientation;
  carried.trust.assign(mesh.positions.size(), trust);
  carried.previousPosition = mesh.positions;
  return carried;
}

inline double angleBetween(const Vec3f& a, const Vec3f& b) {
  return std::atan2(double(a.cross(b).length()), double(a.dot(b)));
}

inline int sumOfTurns(const std::vector<texture::Singularity>& all) {
  return std::accumulate(all.begin(), all.end(), 0,
                         [](int sum, const texture::Singularity& s) { return sum + s.turns; });
}

}  // namespace fluidtex::testing
