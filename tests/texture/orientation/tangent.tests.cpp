#include "texture/orientation/tangent.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

float angleOf(const Complexf& x) {
  return std::arg(x);
}

// Wrapped to (-pi, pi].
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

// The directed edge v -> u.
std::uint32_t edgeIndex(const VertexGraph& graph, std::uint32_t v, std::uint32_t u) {
  const auto ring = graph.around(v);
  return graph.first[v] + std::uint32_t(std::find(ring.begin(), ring.end(), u) - ring.begin());
}

Vec3f inSpace(const Complexf& x, const Vec3f& d, const Vec3f& n) {
  return d * x.real() + rowAxis(d, n) * x.imag();
}

}  // namespace

TEST_CASE("connection: exact in a plane", "[texture]") {
  // The top face of a box, away from its rim, with axes that turn from vertex to vertex.
  const SurfaceMesh mesh = boxMesh({0, 0, 0}, {2, 2, 1}, {12, 12, 6});
  const VertexGraph graph = buildVertexGraph(mesh);
  std::vector<Vec3f> axes = referenceVectors(mesh.normals);
  const auto interior = [&](std::uint32_t v) { return mesh.normals[v].z() > 0.999f; };
  for (std::uint32_t v = 0; v < axes.size(); ++v) {
    if (interior(v)) axes[v] = Vec3f(std::cos(0.7f * v), std::sin(0.7f * v), 0.0f);
  }
  const Connection connection = buildConnection(mesh, graph, axes);
  int checked = 0;
  for (std::uint32_t v = 0; v < axes.size(); ++v) {
    if (!interior(v)) continue;
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      const Vec3f offset = (mesh.positions[u] - mesh.positions[v]) / float(mesh.spacing);
      const Vec3f b = rowAxis(axes[v], mesh.normals[v]);
      REQUIRE(connection.edge[h].real() == Approx(offset.dot(axes[v])).margin(2e-6));
      REQUIRE(connection.edge[h].imag() == Approx(offset.dot(b)).margin(2e-6));
      if (!interior(u)) continue;
      const Complexf x(0.3f, -0.8f);
      const Vec3f there = inSpace(x, axes[u], mesh.normals[u]);
      const Vec3f here = inSpace(connection.rotation[h] * x, axes[v], mesh.normals[v]);
      REQUIRE((there - here).length() < 3e-6f);
      ++checked;
    }
  }
  CHECK(checked > 300);
}

TEST_CASE("connection: an edge is as long as in space and turned by pi from its other end", "[texture]") {
  for (const auto& [name, mesh] : closedMeshes()) {
    INFO(name);
    const VertexGraph graph = buildVertexGraph(mesh);
    const Connection connection = buildConnection(mesh, graph, referenceVectors(mesh.normals));
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      for (const std::uint32_t u : graph.around(v)) {
        const std::uint32_t there = edgeIndex(graph, v, u), back = edgeIndex(graph, u, v);
        const double length = (mesh.positions[u] - mesh.positions[v]).length() / mesh.spacing;
        REQUIRE(std::abs(connection.edge[there]) == Approx(length).epsilon(1e-5));
        // Both ends see one and the same edge, pointing the other way.
        REQUIRE(std::abs(connection.edge[there] + connection.rotation[there] * connection.edge[back]) <
                1e-5 * length);
        // There and back again changes nothing.
        REQUIRE(std::abs(connection.rotation[there] * connection.rotation[back] - 1.0f) < 1e-5f);
        REQUIRE(std::abs(connection.rotation[there]) == Approx(1.0).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("connection: edges keep their order around the vertex, and face angles are scaled to one full turn",
          "[texture]") {
  for (const auto& [name, mesh] : closedMeshes()) {
    INFO(name);
    const VertexGraph graph = buildVertexGraph(mesh);
    const Connection connection = buildConnection(mesh, graph, referenceVectors(mesh.normals));
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      const auto ring = graph.around(v);
      std::vector<double> face;
      double total = 0.0;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const openvdb::Vec3d a(mesh.positions[ring[i]] - mesh.positions[v]);
        const openvdb::Vec3d b(mesh.positions[ring[(i + 1) % ring.size()]] - mesh.positions[v]);
        face.push_back(std::acos(a.unit().dot(b.unit())));
        total += face.back();
      }
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Complexf& e = connection.edge[graph.first[v] + i];
        const Complexf& f = connection.edge[graph.first[v] + (i + 1) % ring.size()];
        REQUIRE(wrapped(angleOf(e) - angleOf(f)) ==
                Approx(face[i] * 2 * std::numbers::pi / total).margin(1e-5));
      }
    }
  }
}

TEST_CASE("connection: turning the axes turns the edges the other way and nothing else", "[texture]") {
  const SurfaceMesh mesh = sphereMesh(6);
  const VertexGraph graph = buildVertexGraph(mesh);
  const std::vector<Vec3f> axes = referenceVectors(mesh.normals);
  std::vector<Vec3f> turned(axes.size());
  std::vector<Complexf> turn(axes.size());
  for (std::uint32_t v = 0; v < axes.size(); ++v) {
    turn[v] = std::polar(1.0f, 2.4f * float(v));
    turned[v] = inSpace(turn[v], axes[v], mesh.normals[v]);
  }
  const Connection first = buildConnection(mesh, graph, axes), second = buildConnection(mesh, graph, turned);
  for (std::uint32_t v = 0; v < axes.size(); ++v) {
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      REQUIRE(std::abs(second.edge[h] * turn[v] - first.edge[h]) < 1e-5f);
      const Complexf expected = first.rotation[h] * turn[graph.neighbor[h]] / turn[v];
      REQUIRE(std::abs(second.rotation[h] - expected) < 1e-5f);
    }
  }
}

TEST_CASE("connection: curvature sums to the Euler characteristic", "[texture]") {
  // The angle by which a vector is turned on its way around each triangle, summed over the closed surface, is
  // 2 pi chi; the sign is that of the angle in (d, b), which runs clockwise seen from outside.
  const std::vector<std::pair<NamedMesh, int>> cases{{{"sphere", sphereMesh(10)}, 2},
                                                     {{"box", boxMesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4})}, 2},
                                                     {{"torus", torusMesh(40, 20)}, 0}};
  for (const auto& [named, chi] : cases) {
    INFO(named.name);
    const SurfaceMesh& mesh = named.mesh;
    const VertexGraph graph = buildVertexGraph(mesh);
    const Connection connection = buildConnection(mesh, graph, referenceVectors(mesh.normals));
    double total = 0.0;
    for (const Vec3I& t : mesh.triangles) {
      // From t[0] to t[1] to t[2] and back: each step takes the vector into the next vertex's axes.
      Complexf around(1.0f, 0.0f);
      for (int i = 0; i < 3; ++i) {
        around *= connection.rotation[edgeIndex(graph, t[(i + 1) % 3], t[i])];
      }
      total -= angleOf(around);
    }
    CHECK(total == Approx(2.0 * std::numbers::pi * chi).margin(1e-3));
  }
}

TEST_CASE("connection: holonomy around a vertex of a sphere is the enclosed curvature", "[texture]") {
  // Once around the ring of neighbours, a vector turns by the area enclosed (unit sphere); an angle defect
  // spread over the triangles approximates it.
  const SurfaceMesh mesh = sphereMesh(12);
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, referenceVectors(mesh.normals));
  double worst = 0.0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto ring = graph.around(v);
    double area = 0.0;
    Complexf around(1.0f, 0.0f);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      area += triangleArea(mesh, Vec3I(v, a, b));
      around *= connection.rotation[edgeIndex(graph, b, a)];
    }
    worst = std::max(worst, std::abs(-angleOf(around) / area - 1.0));
  }
  CHECK(worst < 0.15);
}

TEST_CASE("connection: on a sphere it approaches parallel transport in space", "[texture]") {
  double previous = 1.0;
  for (const int subdivisions : {8, 16, 32}) {
    const SurfaceMesh mesh = sphereMesh(subdivisions);
    const VertexGraph graph = buildVertexGraph(mesh);
    const std::vector<Vec3f> axes = referenceVectors(mesh.normals);
    const Connection connection = buildConnection(mesh, graph, axes);
    double worst = 0.0;
    for (std::uint32_t v = 0; v < axes.size(); ++v) {
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        const Vec3f &from = mesh.normals[u], &to = mesh.normals[v];
        // Rotates `from` into `to` about their common normal.
        const Vec3f k = from.cross(to), x = axes[u];
        const Vec3f carried = x * from.dot(to) + k.cross(x) + k * (k.dot(x) / (1.0f + from.dot(to)));
        worst = std::max(worst, double((carried - inSpace(connection.rotation[h], axes[v], to)).length()));
      }
    }
    CHECK(worst < previous / 1.8);
    previous = worst;
  }
  CHECK(previous < 0.01);
}

TEST_CASE("reference vectors: unit, tangent, and one direction over wide parts", "[texture]") {
  const SurfaceMesh mesh = sphereMesh(20);
  const std::vector<Vec3f> axes = referenceVectors(mesh.normals);
  int along = 0;
  for (std::size_t v = 0; v < axes.size(); ++v) {
    REQUIRE(axes[v].length() == Approx(1.0).epsilon(1e-6));
    REQUIRE(std::abs(axes[v].dot(mesh.normals[v])) < 1e-6f);
    if (axes[v].x() > 0.0f) ++along;
  }
  CHECK(along > int(0.9 * axes.size()));
}
