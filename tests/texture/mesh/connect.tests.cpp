#include "texture/mesh/connect.h"

#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

#include <array>
#include <set>

using namespace fluidtex::texture;

namespace {

std::set<std::array<float, 3>> asSet(const std::vector<Vec3f>& points) {
  std::set<std::array<float, 3>> result;
  for (const Vec3f& p : points) result.insert({p.x(), p.y(), p.z()});
  return result;
}

}  // namespace

TEST_CASE("connect: the vertices are the points, on every side of one voxel a point") {
  for (const double spacing : {0.5, 1.0, 2.0}) {
    INFO("spacing " << spacing << " voxels");
    const auto grid = torusGrid(1.0, 0.4, 0.05);
    const LevelSet phi(*grid);
    const IsoSurface surface = isoSurface(phi);
    const PointSet points = spreadPoints(phi, surface, {}, float(spacing), 1);
    const EditableMesh mesh = connectPoints(phi, surface, points, float(spacing));
    REQUIRE(isClosedManifold(mesh.vertexCount(), trianglesOf(mesh)));
    CHECK(long(mesh.vertexCount()) * 2 - long(mesh.halfEdgeCount() / 3) ==
          0);  // twice the characteristic of a torus
    const auto wanted = asSet(points.position), made = asSet(mesh.position);
    std::size_t common = 0;
    for (const auto& p : wanted) common += made.count(p);
    CHECK(common >= wanted.size() * 99 / 100);
    CHECK(made.size() <= wanted.size() * 101 / 100);
    float worst = 1.0f;
    for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) worst = std::min(worst, worstFacing(mesh, v));
    CHECK(worst >= kFacing);
  }
}
