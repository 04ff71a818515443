#include "caches/liquid/cell_triangles.h"

#include "numerics/random.h"
#include "tests/caches/liquid/surfaces.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

// One triangle, in cells of side 1 from the centre of a cell of the first block.
CellTriangles oneTriangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f half(0.5f);
  return cellTriangles({{a + half, b + half, c + half}, {Vec3I(0, 1, 2)}}, 1.0);
}

std::vector<std::uint32_t> ringOf(const CellTriangles& surface, std::uint32_t point) {
  const auto ring = surface.around(point);
  return {ring.begin(), ring.end()};
}

}  // namespace

TEST_CASE("cell triangles: places count from the centre of a block's lowest cell, amid the surface",
          "[caches]") {
  // The middle lies at cells 2004, -996 and 4.
  const SurfaceTriangles surface{
      {Vec3f(1000.0f, -500.0f, 0.0f), Vec3f(1004.0f, -496.0f, 4.0f), Vec3f(1000.25f, -500.0f, 0.5f)},
      {Vec3I(0, 1, 2)}};
  const CellTriangles got = cellTriangles(surface, 0.5);
  CHECK(got.origin == Coord(2000, -1000, 0));
  CHECK(got.points == std::vector<Vec3f>{Vec3f(-0.5f), Vec3f(7.5f), Vec3f(0.0f, -0.5f, 0.5f)});
  CHECK(got.triangles == surface.triangles);
  CHECK(cellTriangles({}, 0.5).origin == Coord(0));
  CHECK(cellTriangles({}, 0.5).points.empty());
}

TEST_CASE("cell triangles: what is no number or too far counts for nothing, and moves nothing", "[caches]") {
  const SurfaceTriangles ball = surfaceOfBall({}, 2);
  SurfaceTriangles bad = ball;
  const auto n = openvdb::Index32(ball.points.size());
  bad.points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f);
  bad.points.emplace_back(0.0f, -std::numeric_limits<float>::infinity(), 0.0f);
  bad.points.emplace_back(0.0f, 0.0f, 1.1e8f);
  bad.points.emplace_back(0.0f, 0.0f, 0.9e8f);
  for (openvdb::Index32 k = 0; k < 3; ++k) bad.triangles.emplace_back(0, 1, n + k);
  const CellTriangles got = cellTriangles(bad, 0.1);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(std::isnan(got.points[n + k][2]));
    CHECK_FALSE(got.counts(std::uint32_t(ball.triangles.size() + k)));
  }
  CHECK(got.points[n + 3][2] > 0.0f);
  // But for the last point, which is no triangle's, all is as it is without them.
  bad.points.pop_back();
  const CellTriangles without = cellTriangles(ball, 0.1), with = cellTriangles(bad, 0.1);
  CHECK(with.origin == without.origin);
  CHECK(std::equal(without.points.begin(), without.points.end(), with.points.begin()));
  CHECK(std::equal(without.triangles.begin(), without.triangles.end(), with.triangles.begin()));
}

TEST_CASE("cell triangles: those lower than a millionth of a cell count for nothing", "[caches]") {
  for (const float length : {1.0f, 30.0f}) {
    const auto lifted = [&](float height) {
      return oneTriangle(Vec3f(0.0f), Vec3f(length, 0, 0), Vec3f(0.5f * length, height, 0)).counts(0);
    };
    CHECK(lifted(2e-6f));
    CHECK_FALSE(lifted(2e-7f));
    CHECK_FALSE(lifted(0.0f));
  }
  CHECK_FALSE(oneTriangle(Vec3f(0.0f), Vec3f(0.0f), Vec3f(1.0f)).counts(0));
  const CellTriangles flat = oneTriangle(Vec3f(0.0f), Vec3f(1, 0, 0), Vec3f(2, 0, 0));
  CHECK(flat.triangles[0] == Vec3I(0));
  CHECK(flat.ring.empty());
}

TEST_CASE("cell triangles: corners of triangles of their own are one point where they are in one place",
          "[caches]") {
  const SurfaceTriangles ball = surfaceOfBall({}, 1);
  const CellTriangles soup = cellTriangles(asSoup(ball), 0.1), whole = cellTriangles(ball, 0.1);
  REQUIRE(soup.triangles.size() == whole.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t point = soup.triangles[t][corner];
      CHECK(soup.points[point] == whole.points[whole.triangles[t][corner]]);
      // The first of those in its place.
      CHECK(std::size_t(std::find(soup.points.begin(), soup.points.end(), soup.points[point]) -
                        soup.points.begin()) == point);
      CHECK(ringOf(soup, point) == ringOf(whole, whole.triangles[t][corner]));
    }
}

TEST_CASE("cell triangles: around a point are its triangles, ascending, but for flat ones", "[caches]") {
  SurfaceTriangles fan;
  for (const Vec3f& x : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(-1, 0, 0), Vec3f(9, 9, 9)})
    fan.points.push_back(x);
  fan.triangles = {Vec3I(0, 1, 2), Vec3I(3, 0, 1), Vec3I(0, 0, 2), Vec3I(2, 3, 0)};
  fan.points[3] = Vec3f(-1, 0.5f, 0);
  const CellTriangles got = cellTriangles(fan, 1.0);
  CHECK(ringOf(got, 0) == std::vector<std::uint32_t>{0, 1, 3});
  CHECK(ringOf(got, 1) == std::vector<std::uint32_t>{0, 1});
  CHECK(ringOf(got, 2) == std::vector<std::uint32_t>{0, 3});
  CHECK(ringOf(got, 3) == std::vector<std::uint32_t>{1, 3});
  CHECK(ringOf(got, 4).empty());
}

TEST_CASE("cell triangles: the closest point lies on a corner, an edge or the face", "[caches]") {
  const CellTriangles surface = oneTriangle(Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0));
  struct Expected {
    Vec3d place, at, weight;
  };
  const std::vector<Expected> expected{
      {Vec3d(-1, -2, 2), Vec3d(0, 0, 0), Vec3d(1, 0, 0)},
      {Vec3d(6, -1, 0), Vec3d(4, 0, 0), Vec3d(0, 1, 0)},
      {Vec3d(-1, 7, -3), Vec3d(0, 4, 0), Vec3d(0, 0, 1)},
      {Vec3d(1, -2, 1), Vec3d(1, 0, 0), Vec3d(0.75, 0.25, 0)},
      {Vec3d(-2, 3, 0), Vec3d(0, 3, 0), Vec3d(0.25, 0, 0.75)},
      {Vec3d(4, 4, 1), Vec3d(2, 2, 0), Vec3d(0, 0.5, 0.5)},
      {Vec3d(1, 2, -5), Vec3d(1, 2, 0), Vec3d(0.25, 0.25, 0.5)},
  };
  for (const auto& [place, at, weight] : expected) {
    CAPTURE(place);
    const TrianglePoint got = closestPoint(surface, 0, place);
    CHECK((got.offset - (at - place)).length() < 1e-12);
    CHECK(got.square == Approx((at - place).lengthSqr()));
    CHECK((got.weight - weight).length() < 1e-12);
    for (int corner = 0; corner < 3; ++corner) CHECK((got.weight[corner] == 0.0) == (weight[corner] == 0.0));
  }
}

TEST_CASE("cell triangles: closest points of triangles at random", "[caches]") {
  const CellTriangles surface = cellTriangles(randomTriangles(50, 0.5), 0.1);
  double worst = 0.0;
  for (std::uint32_t n = 0; n < 50; ++n)
    for (std::uint64_t k = 0; k < 40; ++k) {
      const auto number = [&](std::uint64_t axis) {
        return 30.0 * randomUnit(3, 200 * n + 5 * k + axis) - 15.0;
      };
      const Vec3d place(number(0), number(1), number(2));
      const Vec3I& t = surface.triangles[n];
      const Vec3d a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
      Vec3d weight;
      const Vec3d at = openvdb::math::closestPointOnTriangleToPoint(a, b, c, place, weight);
      const TrianglePoint got = closestPoint(surface, n, place);
      worst =
          std::max({worst, (place + got.offset - at).length(), std::abs(got.square - got.offset.lengthSqr()),
                    (got.weight[0] * a + got.weight[1] * b + got.weight[2] * c - at).length()});
    }
  CHECK(worst < 1e-9);
}

TEST_CASE("cell triangles: over edges and corners down to the closest of a ball", "[caches]") {
  const Ball ball;
  const SurfaceTriangles given = surfaceOfBall(ball, 3);
  const double h = 0.02;
  const CellTriangles surface = cellTriangles(given, h);
  const Vec3d shift = surface.origin.asVec3d() + Vec3d(0.5);
  int started = 0;
  for (const Vec3d& off : {Vec3d(0.31, 0.02, 0.07), Vec3d(-0.2, 0.21, -0.13), Vec3d(0.03, -0.04, 0.5)}) {
    const Vec3d x = ball.center + off, place = x / h - shift;
    const double closest = distanceToAll(given, x) / h;
    for (std::uint32_t n = 0; n < surface.triangles.size(); ++n) {
      const Vec3I& t = surface.triangles[n];
      const Vec3d a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
      const TrianglePoint first = closestPoint(surface, n, place);
      const Nearest found = descend(surface, place, n, first);
      CHECK(double(found.square) <= first.square * 1.0001);
      CHECK(double(found.square) == Approx(closestPoint(surface, found.triangle, place).square));
      // From behind the ball there is no way that only comes nearer.
      if ((b - a).cross(c - a).dot(place - a) < 0.0) continue;
      CHECK(std::sqrt(found.square) == Approx(closest).epsilon(1e-4));
      ++started;
    }
  }
  CHECK(started > 200);
}
