#include "tools/benchmarks/peers/cgal_remeshing.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <map>
#include <numbers>
#include <utility>

using namespace fluidtex;
using benchmarks::Remeshed;
using texture::Vec3f;
using texture::Vec3I;

TEST_CASE("cgal remeshing: a closed mesh on the same surface, with about one vertex a unit square",
          "[benchmarks]") {
  // Much finer than what is asked for.
  constexpr double kRadius = 6.0;
  const texture::SurfaceMesh sphere = testing::sphereMesh(20, kRadius);
  const double area = 4.0 * std::numbers::pi * kRadius * kRadius;
  REQUIRE(double(sphere.positions.size()) > 4.0 * area);
  const Remeshed even = benchmarks::cgalIsotropicRemeshing(sphere.positions, sphere.triangles, 5);
  CHECK(even.seconds > 0.0);
  // Edges of all lengths between 4/5 and 4/3 of what is asked for are left as they are.
  CHECK(double(even.positions.size()) == Approx(area).epsilon(0.25));
  for (const Vec3f& p : even.positions) REQUIRE(double(p.length()) == Approx(kRadius).epsilon(0.01));
  // Euler's formula for a sphere; each edge once in each direction.
  CHECK(even.triangles.size() == 2 * even.positions.size() - 4);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double length = 0.0, six = 0.0;
  for (const Vec3I& t : even.triangles) {
    for (int k = 0; k < 3; ++k) {
      REQUIRE(t[k] < even.positions.size());
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      ++edges[{a, b}];
      length += double((even.positions[a] - even.positions[b]).length());
    }
    six += double(even.positions[t[0]].dot(even.positions[t[1]].cross(even.positions[t[2]])));
  }
  for (const auto& [edge, count] : edges) {
    REQUIRE(count == 1);
    REQUIRE(edges.count({edge.second, edge.first}) == 1);
  }
  // In a net of equal triangles of one vertex a unit square, edges have the length sqrt(2 / sqrt(3)).
  CHECK(length / double(edges.size()) == Approx(std::sqrt(2.0 / std::numbers::sqrt3)).epsilon(0.1));
  CHECK(six / 6.0 == Approx(kRadius * area / 3.0).epsilon(0.03));
}
