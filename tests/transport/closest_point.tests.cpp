#include "transport/closest_point.h"

#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

// The distance by trying every point of a fine lattice on every triangle: an upper bound close to the truth.
double latticeDistance(const SurfaceMesh& mesh, const Vec3d& x, int steps) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3I& t : mesh.triangles) {
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3d p = a + (b - a) * (double(i) / steps) + (c - a) * (double(j) / steps);
        least = std::min(least, (x - p).length());
      }
    }
  }
  return least;
}

double fraction(int i, double irrational) {
  return std::fmod(i * irrational, 1.0);
}

Vec3d scatteredPoint(int i, double reach) {
  return Vec3d(fraction(i, 0.7548776662), fraction(i, 0.5698402910), fraction(i, 0.8191725134)) *
             (2 * reach) -
         Vec3d(reach);
}

}  // namespace

TEST_CASE("closest point: the least distance over all triangles, near and far", "[transport]") {
  const SurfaceMesh mesh = torusMesh(14, 8);
  const ClosestPoint closest(mesh.positions, mesh.triangles);
  const int steps = 24;
  for (const double reach : {1.5, 40.0}) {
    for (int i = 0; i < 150; ++i) {
      const Vec3d x = scatteredPoint(i, reach);
      const SurfacePoint point = closest.nearest(x, Vec3f(0, 0, 1), 0.0);
      const double bound = latticeDistance(mesh, x, steps);
      REQUIRE(point.distance <= bound + 1e-5 * reach);
      REQUIRE(point.distance > bound - 0.5 / steps);
    }
  }
}

TEST_CASE("closest point: weights, position and distance belong together", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(10);
  const ClosestPoint closest(mesh.positions, mesh.triangles);
  for (int i = 1; i < 500; ++i) {
    const Vec3d x = scatteredPoint(i, 1.4);
    const SurfacePoint point = closest.nearest(x, Vec3f(x.unit()), 1.0);
    const Vec3I& t = mesh.triangles[point.triangle];
    Vec3d p(0.0);
    for (int k = 0; k < 3; ++k) {
      REQUIRE(point.weight[k] >= -1e-6f);
      p += Vec3d(mesh.positions[t[k]]) * double(point.weight[k]);
    }
    REQUIRE(point.weight[0] + point.weight[1] + point.weight[2] == Approx(1.0).epsilon(1e-5));
    REQUIRE((p - point.position).length() < 1e-6);
    REQUIRE(point.distance == Approx((x - p).length()).margin(1e-6));
    // On a finely divided sphere the closest point lies towards the centre.
    REQUIRE(point.distance == Approx(std::abs(x.length() - 1.0)).margin(0.01));
  }
}

TEST_CASE("closest point: vertices find themselves", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(16, 0.01, {3, -2, 5});
  const ClosestPoint closest(mesh.positions, mesh.triangles);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const SurfacePoint point = closest.nearest(Vec3d(mesh.positions[v]), mesh.normals[v], 0.01);
    REQUIRE(point.distance == 0.0);
    REQUIRE(point.position == Vec3d(mesh.positions[v]));
  }
}

TEST_CASE("closest point: each side of a thin sheet is found from beyond its middle", "[transport]") {
  const SurfaceMesh sheet = boxMesh({0, 0, 0}, {1, 1, 0.02}, {40, 40, 1});
  const ClosestPoint closest(sheet.positions, sheet.triangles);
  for (int i = 0; i < 200; ++i) {
    const double x = 0.2 + 0.6 * fraction(i, 0.7548776662), y = 0.2 + 0.6 * fraction(i, 0.5698402910);
    // Three quarters of the way through, as seen from the side whose normal is asked for.
    CHECK(closest.nearest({x, y, 0.005}, {0, 0, 1}, 0.1).position.z() == Approx(0.02).margin(1e-6));
    CHECK(closest.nearest({x, y, 0.015}, {0, 0, -1}, 0.1).position.z() == Approx(0.0).margin(1e-6));
    CHECK(closest.nearest({x, y, 0.005}, {0, 0, 1}, 0.0).position.z() == Approx(0.0).margin(1e-6));
    // But a side that is missing altogether is replaced by the other.
    CHECK(closest.nearest({x, y, 0.5}, {0, 0, -1}, 0.1).position.z() == Approx(0.02).margin(1e-6));
  }
}

TEST_CASE("closest point: ties go to the triangle with the smaller index", "[transport]") {
  // Twice the same mesh in one, and queries on vertices and edges that many triangles share.
  const SurfaceMesh mesh = sphereMesh(4);
  std::vector<Vec3I> twice = mesh.triangles;
  twice.insert(twice.end(), mesh.triangles.begin(), mesh.triangles.end());
  const ClosestPoint closest(mesh.positions, twice);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::uint32_t smallest = 0;
    while (twice[smallest][0] != v && twice[smallest][1] != v && twice[smallest][2] != v) ++smallest;
    REQUIRE(closest.nearest(Vec3d(mesh.positions[v]), mesh.normals[v], 0.0).triangle == smallest);
  }
}

TEST_CASE("closest point: triangles without area and very unlike sizes do no harm", "[transport]") {
  std::vector<Vec3f> positions{{0, 0, 0}, {100, 0, 0},    {0, 100, 0},
                               {1, 1, 1}, {1.001f, 1, 1}, {1, 1.001f, 1}};
  const std::vector<Vec3I> triangles{{0, 1, 2}, {3, 4, 5}, {3, 3, 4}, {5, 5, 5}};
  const ClosestPoint closest(positions, triangles);
  CHECK(closest.nearest({30, 30, 1}, {0, 0, 1}, 0.0).distance == Approx(1.0));
  CHECK(closest.nearest({1.0002, 1.0002, 1.2}, {0, 0, 1}, 0.0).triangle == 1);
  CHECK(closest.nearest({-3, -4, 0}, {0, 0, 1}, 0.0).distance == Approx(5.0));
}

TEST_CASE("closest point: no triangles, and ones without their vertices, are refused", "[transport]") {
  const std::vector<Vec3f> positions(3, Vec3f(0.0f));
  CHECK_THROWS_AS(ClosestPoint(positions, {}), std::invalid_argument);
  const std::vector<Vec3I> beyond{Vec3I(0, 1, 3)};
  CHECK_THROWS_AS(ClosestPoint(positions, beyond), std::invalid_argument);
}
