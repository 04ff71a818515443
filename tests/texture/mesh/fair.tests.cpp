// No vertex sticks out and no edge folds, whatever the level set and however fine or coarse the points.
#include "texture/mesh/fair.h"

#include "closed_meshes.h"
#include "mesh_quality.h"
#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/mesh_faults.h"
#include "texture/mesh/mesh_stats.h"
#include "texture/mesh/prepare.h"
#include "texture/mesh/round_drops.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

namespace {

constexpr double kVoxel = 0.1;

void requireFair(const SurfaceMesh& mesh, const FloatGrid& grid) {
  requireSound(mesh, grid);
  const MeshStats stats = meshStats(mesh.positions, mesh.triangles, mesh.normals);
  CHECK(stats.folded == 0);
  CHECK(stats.spikes == 0);
}

// From points at random, and then carried on a little, with the mesh.
void requireFairAt(double ratio) {
  for (const auto& [name, grid] : sharpGrids(kVoxel)) {
    INFO(name << ", spacing " << ratio << " voxels");
    const SurfaceMesh first = prepareSurface(*grid, ratio * kVoxel, Seeds{}, 1, {}).levels[0];
    requireFair(first, *grid);
    Seeds seeds{first.positions, first.positions, first.triangles, {}};
    for (Vec3f& p : seeds.positions) p += Vec3f(0.01f * std::sin(20.0f * p.y()), 0.0f, 0.005f);
    requireFair(prepareSurface(*grid, ratio * kVoxel, seeds, 1, {}).levels[0], *grid);
  }
}

void requireFairSplash(std::uint64_t seed) {
  const FloatGrid::Ptr grid = splashGrid(15, kVoxel, seed);
  for (const double ratio : {0.15, 0.5, 1.0, 2.0}) {
    INFO("splash " << seed << ", spacing " << ratio << " voxels");
    requireFair(prepareSurface(*grid, ratio * kVoxel, Seeds{}, 1, {}).levels[0], *grid);
  }
}

EditableMesh editable(const SurfaceMesh& surface) {
  EditableMesh mesh = makeEditableMesh(surface.positions, surface.triangles);
  mesh.normal = surface.normals;
  return mesh;
}

}  // namespace

TEST_CASE("fair: thin, sharp and small surfaces, points as far apart as the grid and farther", "[texture]") {
  for (const double ratio : {0.7, 1.0, 1.4, 2.0}) requireFairAt(ratio);
}

TEST_CASE("fair: thin, sharp and small surfaces, points much finer than the grid", "[texture][slow]") {
  for (const double ratio : {0.1, 0.2, 0.4}) requireFairAt(ratio);
}

TEST_CASE("fair: a splash, at any spacing", "[texture][slow]") {
  requireFairSplash(1);
}

TEST_CASE("fair: more splashes, at any spacing", "[texture][long]") {
  for (std::uint64_t seed = 2; seed <= 6; ++seed) requireFairSplash(seed);
}

TEST_CASE("fair: a mesh that is fair keeps its bytes", "[texture]") {
  const auto grid = sphereGrid(8.0 * kVoxel, kVoxel);
  const EditableMesh before = editable(prepareSurface(*grid, 0.7 * kVoxel, Seeds{}, 1, {}).levels[0]);
  EditableMesh after = before;
  fair(after, LevelSet(*grid));
  CHECK(after.position == before.position);
  CHECK(after.normal == before.normal);
  CHECK(after.origin == before.origin);
}

TEST_CASE("fair: a spike and a crumple are smoothed away, and what is far from them stays", "[texture]") {
  const auto grid = sphereGrid(10.0 * kVoxel, kVoxel, Vec3d(0.0));
  const LevelSet phi(*grid);
  const SurfaceMesh ball = fluidtex::testing::sphereMesh(16, 10.0);  // voxels
  for (const bool crumpled : {false, true}) {
    EditableMesh mesh = editable(ball);
    const std::uint32_t v = 100;
    if (crumpled) {  // thrown over its neighbours
      Vec3f way = mesh.position[mesh.target(mesh.outgoing[v])] - mesh.position[v];
      mesh.position[v] += way * 2.5f;
    } else {
      mesh.position[v] *= 1.2f;
    }
    const Vec3f place = mesh.position[v];
    REQUIRE_FALSE(faultsOf(mesh).none());
    const EditableMesh before = mesh;
    fair(mesh, phi);
    mesh.compact(mesh.vertexCount());
    CHECK(faultsOf(mesh).none());
    CHECK(isClosedManifold(mesh.vertexCount(), trianglesOf(mesh)));
    CHECK(mesh.position[v].length() < 10.8f);  // it was 12
    std::size_t kept = 0;
    for (std::uint32_t u = 0; u < before.vertexCount(); ++u) {
      if ((before.position[u] - place).length() < 6.0f * float(ball.spacing)) continue;
      ++kept;
      CHECK(mesh.position[u] == before.position[u]);
      CHECK(mesh.normal[u] == before.normal[u]);
    }
    CHECK(kept > before.vertexCount() * 9 / 10);
  }
}

TEST_CASE("fair: a drop of four vertices becomes a ball about the same middle, and of the same radius",
          "[texture]") {
  const auto grid = sphereGrid(3.0 * kVoxel, kVoxel, Vec3d(0.0));
  std::vector<Vec3f> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (Vec3f& p : corners) p = p * float(1.0 / std::sqrt(3.0)) + Vec3f(5.0f, 0.0f, 0.0f);
  EditableMesh mesh = makeEditableMesh(corners, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  CHECK_FALSE(faultsOf(mesh).none());
  fair(mesh, LevelSet(*grid));
  mesh.compact(0);
  REQUIRE(mesh.vertexCount() == kBallVertices);
  CHECK(isClosedManifold(mesh.vertexCount(), trianglesOf(mesh)));
  CHECK(faultsOf(mesh).none());
  for (const Vec3f& p : mesh.position) CHECK((p - Vec3f(5.0f, 0.0f, 0.0f)).length() == Approx(1.0));
  CHECK(enclosed(mesh.position, trianglesOf(mesh)) > 2.5);  // of 4.19
}
