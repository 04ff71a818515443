#include "texture/mesh/vertex_graph.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <stdexcept>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("vertex graph: rings hold each neighbour once, counter-clockwise from outside", "[texture]") {
  for (const auto& [name, mesh] : closedMeshes()) {
    INFO(name);
    const VertexGraph graph = buildVertexGraph(mesh);
    REQUIRE(graph.first.size() == mesh.positions.size() + 1);
    REQUIRE(graph.neighbor.size() == 3 * mesh.triangles.size());

    std::set<std::array<std::uint32_t, 3>> faces;
    for (const Vec3I& t : mesh.triangles) {
      for (int i = 0; i < 3; ++i) faces.insert({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
    }
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      const auto ring = graph.around(v);
      REQUIRE(std::set<std::uint32_t>(ring.begin(), ring.end()).size() == ring.size());
      for (std::size_t i = 0; i < ring.size(); ++i) {
        REQUIRE(faces.count({v, ring[i], ring[(i + 1) % ring.size()]}) == 1);
      }
    }
  }
}

TEST_CASE("vertex graph: meshes that are not closed and manifold are refused", "[texture]") {
  SurfaceMesh mesh = sphereMesh(2);
  SECTION("a hole") {
    mesh.triangles.pop_back();
  }
  SECTION("a triangle twice") {
    mesh.triangles.push_back(mesh.triangles.front());
  }
  SECTION("a triangle turned over") {
    std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  }
  SECTION("a vertex that does not exist") {
    mesh.triangles[3][1] = 9999;
  }
  SECTION("a vertex without triangles") {
    mesh.positions.emplace_back(0.0f);
    mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
  }
  SECTION("a triangle with one vertex twice") {
    mesh.triangles[3][1] = mesh.triangles[3][0];
  }
  SECTION("two spheres that share a vertex") {
    SurfaceMesh other = sphereMesh(2, 1.0, {5, 0, 0});
    const auto offset = std::uint32_t(mesh.positions.size());
    const auto moved = [&](std::uint32_t v) { return v == 0 ? 0 : v + offset; };
    for (const Vec3I& t : other.triangles) mesh.triangles.emplace_back(moved(t[0]), moved(t[1]), moved(t[2]));
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  }
  CHECK_THROWS_AS(buildVertexGraph(mesh), std::invalid_argument);
}
