#include "texture/mesh/connect.h"

#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/remesh.h"

#include <catch2/catch.hpp>

#include <array>
#include <set>

using namespace fluidtex::texture;

namespace {

EditableMesh icosahedron() {
  const float g = 1.618034f;
  std::vector<Vec3f> p{{0, 1, g},  {0, -1, g},  {0, 1, -g}, {0, -1, -g}, {1, g, 0},  {-1, g, 0},
                       {1, -g, 0}, {-1, -g, 0}, {g, 0, 1},  {-g, 0, 1},  {g, 0, -1}, {-g, 0, -1}};
  std::vector<Vec3I> triangles;
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        const auto near = [&](std::uint32_t i, std::uint32_t j) { return (p[i] - p[j]).lengthSqr() < 4.1f; };
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const bool outward = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[a]) > 0.0f;
        triangles.push_back(outward ? Vec3I(a, b, c) : Vec3I(a, c, b));
      }
    }
  }
  EditableMesh mesh = makeEditableMesh(p, triangles);
  for (std::size_t v = 0; v < p.size(); ++v) mesh.normal[v] = p[v].unit();
  return mesh;
}

bool sound(EditableMesh mesh) {
  for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h) {
    if (!mesh.alive(h)) continue;
    if (mesh.twin[mesh.twin[h]] != h || mesh.origin[mesh.twin[h]] != mesh.target(h)) return false;
  }
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (mesh.outgoing[v] != EditableMesh::kNone && mesh.origin[mesh.outgoing[v]] != v) return false;
  }
  mesh.compact(12);
  return isClosedManifold(mesh.vertexCount(), trianglesOf(mesh));
}

std::set<std::array<float, 3>> asSet(const std::vector<Vec3f>& points) {
  std::set<std::array<float, 3>> result;
  for (const Vec3f& p : points) result.insert({p.x(), p.y(), p.z()});
  return result;
}

}  // namespace

TEST_CASE("editable mesh: flips, splits and collapses keep it closed and manifold") {
  EditableMesh mesh = icosahedron();
  REQUIRE(sound(mesh));
  std::uint64_t random = 1;
  const auto next = [&](std::size_t n) {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return std::uint32_t((random >> 33) % n);
  };
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t h = next(mesh.halfEdgeCount());
    if (!mesh.alive(h)) continue;
    switch (next(4)) {
      case 0:
        if (mesh.canFlip(h)) mesh.flip(h);
        break;
      case 1:
        mesh.splitEdge(h, Vec3f(float(i)), Vec3f(0.0f));
        break;
      case 2:
        mesh.splitTriangle(h / 3, Vec3f(float(i)), Vec3f(0.0f));
        break;
      default:  // twice as likely to shrink as each split is to grow
        for (std::uint32_t k = 0; k < 4; ++k) {
          const std::uint32_t e = next(mesh.halfEdgeCount());
          if (mesh.alive(e) && mesh.canCollapse(e)) mesh.collapse(e);
        }
    }
    if (i % 100 == 0) REQUIRE(sound(mesh));
  }
  REQUIRE(sound(mesh));
}

TEST_CASE("editable mesh: a component shrinks to a tetrahedron and no further") {
  EditableMesh mesh = icosahedron();
  bool any = true;
  while (any) {
    any = false;
    for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h) {
      if (!mesh.alive(h) || !mesh.canCollapse(h)) continue;
      mesh.collapse(h);
      any = true;
    }
  }
  mesh.compact(12);
  CHECK(mesh.vertexCount() == 4);
  CHECK(isClosedManifold(4, trianglesOf(mesh)));
}

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
