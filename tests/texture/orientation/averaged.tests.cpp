#include "texture/orientation/averaged.h"

#include "tests/texture/mesh/closed_meshes.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

const auto kAsItComes = [](double value, std::uint32_t) { return value; };

}  // namespace

TEST_CASE("averaged: a value spreads as wide as is said", "[texture]") {
  // Every vertex of this torus has six neighbours: it is a lattice of equal triangles, wrapped twice.
  constexpr int kAround = 60;
  const VertexGraph graph = buildVertexGraph(torusMesh(kAround, kAround));
  std::vector<double> value(kAround * kAround, 0.0);
  constexpr int kMiddle = kAround / 2;
  value[kMiddle * kAround + kMiddle] = 1.0;
  for (const int sweeps : {0, 1, 5, 12}) {
    const std::vector<double> spread = averaged(graph, value, sweeps, kAsItComes);
    double total = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int i = 0; i < kAround; ++i)
      for (int j = 0; j < kAround; ++j) {
        const double x = i - kMiddle - 0.5 * (j - kMiddle), y = std::sqrt(0.75) * (j - kMiddle);
        const double weight = spread[std::size_t(i * kAround + j)];
        total += weight, xx += weight * x * x, xy += weight * x * y, yy += weight * y * y;
      }
    CHECK(total == Approx(1.0));
    // Along each axis, three sevenths of an edge's square a sweep: 0.655 edges.
    CHECK(xx == Approx(3.0 / 7.0 * sweeps).margin(1e-6));
    CHECK(yy == Approx(3.0 / 7.0 * sweeps).margin(1e-6));
    CHECK(xy == Approx(0.0).margin(1e-6));
  }
}

TEST_CASE("averaged: values come over the edge to the neighbour that has them", "[texture]") {
  const SurfaceMesh mesh = boxMesh({0, 0, 0}, {1, 2, 1}, {3, 5, 4});
  const VertexGraph graph = buildVertexGraph(mesh);
  // Heights, brought by the way that the edge climbs, are the vertex's own.
  std::vector<double> height;
  for (const Vec3f& x : mesh.positions) height.push_back(double(x.z() + 0.3f * x.y()));
  std::vector<std::uint32_t> from(graph.neighbor.size());
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) from[h] = v;
  const std::vector<double> still = averaged(graph, height, 4, [&](double value, std::uint32_t h) {
    return value + height[from[h]] - height[graph.neighbor[h]];
  });
  for (std::size_t v = 0; v < still.size(); ++v) CHECK(still[v] == Approx(height[v]).margin(1e-6));
}

TEST_CASE("averaged: the same on one thread and on two", "[texture]") {
  const SurfaceMesh mesh = sphereMesh(16);
  const VertexGraph graph = buildVertexGraph(mesh);
  std::vector<double> value;
  for (const Vec3f& x : mesh.positions) value.push_back(std::sin(40.0 * double(x.x() + x.y() * x.z())));
  const auto on = [&](int threads) {
    return onThreads(threads, [&] { return averaged(graph, value, 7, kAsItComes); });
  };
  CHECK(on(1) == on(2));
}
