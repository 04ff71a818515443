#include "texture/mesh/carried_mesh.h"

#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/prepare.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

namespace {

constexpr double kVoxel = 0.1;

// The mesh of one level set brought onto another one of the same transform.
std::optional<EditableMesh> carriedOnto(const FloatGrid& from, const FloatGrid& to) {
  const SurfaceMesh mesh = prepareSurface(from, kVoxel, Seeds{}, 1, SurfaceOptions{}).levels[0];
  std::vector<Vec3f> points;
  for (const Vec3f& p : mesh.positions) points.emplace_back(from.worldToIndex(Vec3d(p)));
  const LevelSet phi(to);
  const IsoSurface surface = isoSurface(phi);
  return carriedMesh(phi, surface, componentsOf(surface.positions, surface.triangles), points, mesh.triangles,
                     kEdgePerSpacing);
}

// Balls of radius 0.4 whose centres lie on the x axis.
FloatGrid::Ptr balls(const std::vector<double>& x) {
  return levelSetOf(kVoxel, Vec3d(3.0, 0.9, 0.9), [=](const Vec3d& p) {
    double nearest = 10.0;
    for (double c : x) nearest = std::min(nearest, (p - Vec3d(c, 0.01, 0.02)).length() - 0.4);
    return nearest;
  });
}

}  // namespace

TEST_CASE("carried mesh: components with their characteristic and area") {
  const IsoSurface torus = isoSurface(LevelSet(*torusGrid(1.0, 0.4, kVoxel)));
  const Components one = componentsOf(torus.positions, torus.triangles);
  REQUIRE(one.parts.size() == 1);
  CHECK(one.parts[0].characteristic == 0);
  CHECK(one.parts[0].area * kVoxel * kVoxel == Approx(4.0 * M_PI * M_PI * 0.4).epsilon(0.02));
  const IsoSurface two = isoSurface(LevelSet(*balls({-1.0, 1.0})));
  const Components both = componentsOf(two.positions, two.triangles);
  REQUIRE(both.parts.size() == 2);
  for (const auto& part : both.parts) {
    CHECK(part.characteristic == 2);
    CHECK(part.area * kVoxel * kVoxel == Approx(4.0 * M_PI * 0.16).epsilon(0.04));
  }
  CHECK(!sameTopology(one, both));
}

TEST_CASE("carried mesh: kept while the surface only moves, with its points on it") {
  const auto to = balls({-0.95, 1.05});
  const std::optional<EditableMesh> mesh = carriedOnto(*balls({-1.0, 1.0}), *to);
  REQUIRE(mesh);
  const LevelSet phi(*to);
  for (const Vec3f& p : mesh->position) CHECK(std::abs(phi.sample(p).value) < 0.01f);
}

TEST_CASE("carried mesh: not kept where liquid merges, tears, vanishes or appears") {
  CHECK_FALSE(carriedOnto(*twoSpheresGrid(0.04, kVoxel), *twoSpheresGrid(-0.04, kVoxel)));
  CHECK_FALSE(carriedOnto(*twoSpheresGrid(-0.04, kVoxel), *twoSpheresGrid(0.04, kVoxel)));
  CHECK_FALSE(carriedOnto(*balls({-1.5, 0.0}), *balls({-1.5})));
  CHECK_FALSE(carriedOnto(*balls({-1.5}), *balls({-1.5, 0.0})));
  // As many as before, but one is another one.
  CHECK_FALSE(carriedOnto(*balls({-1.5, 0.0}), *balls({-1.5, 1.5})));
}
