#include "texture/mesh/editable_mesh.h"

#include "tests/texture/mesh/characteristics.h"
#include "tests/texture/mesh/icosahedron.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace fluidtex::texture;

namespace {

bool sound(EditableMesh mesh) {
  for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h) {
    if (!mesh.alive(h)) continue;
    if (mesh.twin[mesh.twin[h]] != h || mesh.origin[mesh.twin[h]] != mesh.target(h)) return false;
  }
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (mesh.outgoing[v] != kNone && mesh.origin[mesh.outgoing[v]] != v) return false;
  }
  mesh.compact(12);
  return isClosedManifold(mesh.vertexCount(), trianglesOf(mesh));
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

TEST_CASE("editable mesh: the half-edges around a vertex lead to its neighbours, each once") {
  const EditableMesh mesh = icosahedron();
  for (std::uint32_t v = 0; v < 12; ++v) {
    CHECK(mesh.valence(v) == 5);
    std::vector<int> met(12, 0);
    mesh.around(v, [&](std::uint32_t h) {
      CHECK(mesh.origin[h] == v);
      ++met[mesh.target(h)];
    });
    for (std::uint32_t u = 0; u < 12; ++u) {
      const bool near = u != v && (mesh.position[u] - mesh.position[v]).length() < 2.1f;
      CHECK(met[u] == (near ? 1 : 0));
      CHECK(mesh.connected(v, u) == near);
    }
  }
}

TEST_CASE("editable mesh: a flip joins the opposite corners, two more are the old edge again") {
  EditableMesh mesh = icosahedron();
  const std::uint32_t a = mesh.origin[0], b = mesh.target(0), c = mesh.opposite(0),
                      d = mesh.opposite(mesh.twin[0]);
  REQUIRE(mesh.canFlip(0));
  mesh.flip(0);
  CHECK_FALSE(mesh.connected(a, b));
  CHECK(mesh.connected(c, d));
  CHECK(mesh.origin[0] == a);
  CHECK(mesh.target(0) == d);
  mesh.flip(EditableMesh::next(0));
  CHECK(mesh.connected(a, b));
  CHECK_FALSE(mesh.connected(c, d));
}

TEST_CASE("editable mesh: a component goes, and comes back as a part") {
  EditableMesh mesh = icosahedron();
  const EditableMesh other = icosahedron();
  mesh.append(other);
  CHECK(fluidtex::testing::characteristics(24, trianglesOf(mesh)) == std::map<long, int>{{2, 2}});
  CHECK(components(24, trianglesOf(mesh))[23] == 12);
  std::vector<std::uint32_t> first(12);
  std::iota(first.begin(), first.end(), 0u);
  mesh.removeComponent(first);
  mesh.compact(24);
  CHECK(mesh.position == other.position);
  CHECK(isClosedManifold(12, trianglesOf(mesh)));
}

TEST_CASE("editable mesh: what is no closed manifold is told") {
  const std::vector<Vec3I> tetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  CHECK(isClosedManifold(4, tetrahedron));
  std::vector<Vec3I> open = tetrahedron, turned = tetrahedron, pinched = tetrahedron;
  open.pop_back();
  CHECK_FALSE(isClosedManifold(4, open));
  std::swap(turned[0][1], turned[0][2]);
  CHECK_FALSE(isClosedManifold(4, turned));
  // Two tetrahedra that share a vertex.
  for (const Vec3I& t : tetrahedron) {
    Vec3I moved = t;
    for (int k = 0; k < 3; ++k)
      if (moved[k] != 0) moved[k] += 3;
    pinched.push_back(moved);
  }
  CHECK_FALSE(isClosedManifold(7, pinched));
}
