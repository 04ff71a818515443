// What is asked of a prepared mesh, measured.
#pragma once

#include "tests/texture/levelset/level_sets.h"
#include "tests/texture/mesh/characteristics.h"
#include "texture/levelset/isosurface.h"
#include "texture/mesh/editable_mesh.h"

#include <catch2/catch.hpp>

#include <array>

namespace fluidtex::texture {

struct Quality {
  double variation = 0.0;                      // of the edge lengths: standard deviation / mean
  double slim = 0.0;                           // share of triangles with an angle under 20 degrees
  double distance = 0.0, worstDistance = 0.0;  // voxels, of corners and centres from the level set
  // Triangles that face against the gradient at their centre, but those of specks.
  int folded = 0;
};

// In voxels. A component that a single grid node makes has triangles smaller than this: the interpolated phi
// knows no such component, and its gradient there is of no account.
inline constexpr double kSpeck = 0.1;

inline Quality measure(const SurfaceMesh& mesh, const FloatGrid& grid) {
  const LevelSet phi(grid);
  Quality q;
  double sum = 0.0, squares = 0.0, distances = 0.0;
  std::size_t edges = 0, samples = 0, slim = 0;
  const auto addDistance = [&](const Vec3d& p) {
    const LevelSet::Sample s = phi.sample(Vec3f(grid.worldToIndex(p)));
    REQUIRE(s.known);
    distances += std::abs(s.value);
    q.worstDistance = std::max(q.worstDistance, double(std::abs(s.value)));
    ++samples;
    return Vec3d(s.gradient);
  };
  for (const Vec3f& p : mesh.positions) addDistance(Vec3d(p));
  for (const Vec3I& t : mesh.triangles) {
    const std::array<Vec3d, 3> p{Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                                 Vec3d(mesh.positions[t[2]])};
    bool isSlim = false;
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      isSlim = isSlim || std::atan2(a.cross(b).length(), a.dot(b)) < 20.0 * M_PI / 180.0;
      longest = std::max(longest, a.length());
      sum += a.length();
      squares += a.lengthSqr();
      ++edges;
    }
    slim += isSlim;
    const Vec3d gradient = addDistance((p[0] + p[1] + p[2]) / 3.0);
    if (longest < kSpeck * grid.voxelSize()[0]) continue;
    q.folded += (p[1] - p[0]).cross(p[2] - p[0]).dot(gradient) <= 0.0;
  }
  const double mean = sum / double(edges);
  q.variation = std::sqrt(std::max(0.0, squares / double(edges) - mean * mean)) / mean;
  q.slim = double(slim) / double(mesh.triangles.size());
  q.distance = distances / double(samples);
  return q;
}

// What must hold for every level set, however wild.
inline void requireSound(const SurfaceMesh& mesh, const FloatGrid& grid) {
  const IsoSurface iso = isoSurface(LevelSet(grid));
  REQUIRE(isClosedManifold(mesh.positions.size(), mesh.triangles));
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  CHECK(fluidtex::testing::characteristics(mesh.positions.size(), mesh.triangles) ==
        fluidtex::testing::characteristics(iso.positions.size(), iso.triangles));
  for (const Vec3f& n : mesh.normals) CHECK(n.length() == Approx(1.0f).margin(1e-4));
  for (const Vec3f& p : mesh.positions) CHECK(std::isfinite(p.lengthSqr()));
}

// What is promised besides, but for the share of slim triangles, while the spacing is at most one voxel.
inline void checkPromises(const Quality& q) {
  CHECK(q.distance < 0.1);
  CHECK(q.worstDistance < 0.5);
  CHECK(q.folded == 0);
  CHECK(q.variation <= 0.15);
}

// Signed volume inside a closed mesh.
inline double enclosed(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  double six = 0.0;
  for (const Vec3I& t : triangles)
    six += Vec3d(positions[t[0]]).dot(Vec3d(positions[t[1]]).cross(Vec3d(positions[t[2]])));
  return six / 6.0;
}

}  // namespace fluidtex::texture
