#include "caches/liquid/closest_triangles.h"

#include "tests/caches/liquid/surfaces.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <map>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;

namespace {

constexpr double kSideOfCells = 0.05;

// By cell: the distance that is said, cells.
std::map<Coord, double> knownOf(const ClosestTriangles& closest) {
  std::map<Coord, double> known;
  for (std::int64_t cell = 0; cell < std::int64_t(closest.blocks().voxels()); ++cell)
    if (sim::isSet(closest.known(), cell))
      known[closest.blocks().coord(cell)] = std::sqrt(double(closest.at(cell).square));
  return known;
}

Vec3d centerOf(const Coord& cell) {
  return kSideOfCells * (cell.asVec3d() + Vec3d(0.5));
}

double trueDistance(const SurfaceTriangles& surface, const Coord& cell) {
  return distanceToAll(surface, centerOf(cell)) / kSideOfCells;
}

// Cells of a box, for which all is compared.
const openvdb::CoordBBox kBox(Coord(-8), Coord(29));

}  // namespace

TEST_CASE("closest triangles: up to two cells away all cells, and their distances exactly", "[caches]") {
  for (const SurfaceTriangles& surface :
       {surfaceOfBall({}, 2), surfaceOfBox(Vec3d(0.125), Vec3d(0.875, 0.62, 0.525)),
        randomTriangles(40, 0.4)}) {
    const ClosestTriangles closest(surface, kSideOfCells);
    CHECK(closest.cellSize() == kSideOfCells);
    CHECK(&closest.surface() == &surface);
    const auto known = knownOf(closest);
    double worst = 0.0;
    for (auto cell = kBox.begin(); cell; ++cell) {
      const double distance = trueDistance(surface, *cell);
      const auto at = known.find(*cell);
      if (std::abs(distance - 2.0) > 1e-3) REQUIRE((at != known.end()) == (distance < 2.0));
      if (at != known.end()) worst = std::max(worst, std::abs(at->second - distance));
    }
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("closest triangles: farther away as well, of a ball the closest ones", "[caches]") {
  const SurfaceTriangles surface = surfaceOfBall({}, 3);
  ClosestTriangles closest(surface, kSideOfCells);
  closest.extend(6.0);
  const auto known = knownOf(closest);
  for (auto cell = kBox.begin(); cell; ++cell) {
    // Around the ball's middle all triangles are about as near.
    const double distance = trueDistance(surface, *cell);
    if (Ball{}.distance(centerOf(*cell)) < 0.0) continue;
    const auto at = known.find(*cell);
    if (std::abs(distance - 6.0) > 1e-2) REQUIRE((at != known.end()) == (distance < 6.0));
    if (at != known.end()) REQUIRE(at->second == Approx(distance).margin(1e-3));
  }
  // A reach that is known already.
  closest.extend(3.0);
  CHECK(knownOf(closest) == known);
}

TEST_CASE("closest triangles: of triangles at random, none is said to be nearer than it is", "[caches]") {
  const SurfaceTriangles surface = randomTriangles(40, 0.4);
  ClosestTriangles closest(surface, kSideOfCells);
  closest.extend(3.0);
  closest.extend(5.0);
  double tooNear = 0.0, tooFar = 0.0;
  int count = 0;
  for (const auto& [cell, distance] : knownOf(closest)) {
    CHECK(distance < 5.0);
    const double error = distance - trueDistance(surface, cell);
    tooNear = std::max(tooNear, -error);
    tooFar = std::max(tooFar, error);
    ++count;
  }
  CHECK(count > 10000);
  CHECK(tooNear < 1e-3);
  CHECK(tooFar < 0.5);
}

TEST_CASE("closest triangles: the closest point is that of the triangle", "[caches]") {
  const SurfaceTriangles surface = surfaceOfBall({}, 2);
  ClosestTriangles closest(surface, kSideOfCells);
  closest.extend(4.0);
  for (std::int64_t cell = 0; cell < std::int64_t(closest.blocks().voxels()); ++cell) {
    if (!sim::isSet(closest.known(), cell)) continue;
    const TrianglePoint point = closest.closestPointOf(cell);
    const openvdb::Vec3I& t = surface.triangles[closest.at(cell).triangle];
    Vec3d there(0.0);
    for (int corner = 0; corner < 3; ++corner)
      there += point.weight[corner] * Vec3d(surface.points[t[corner]]);
    REQUIRE((centerOf(closest.blocks().coord(cell)) + kSideOfCells * point.offset - there).length() < 1e-5);
    REQUIRE(closest.at(cell).square == Approx(point.square).margin(1e-4));
  }
}

TEST_CASE("closest triangles: lines are crossed where the surface lies between two cells", "[caches]") {
  const SurfaceTriangles surface = surfaceOfBall({}, 3);
  const ClosestTriangles closest(surface, kSideOfCells);
  REQUIRE(closest.crossed().size() == closest.blocks().size());
  int crossed = 0;
  for (std::int64_t cell = 0; cell < std::int64_t(closest.blocks().voxels()); ++cell)
    for (int axis = 0; axis < 3; ++axis) {
      const Coord low = closest.blocks().coord(cell);
      Coord high = low;
      ++high[axis];
      // The triangles lie up to 0.02 of a cell within the ball.
      const double a = Ball{}.distance(centerOf(low)) / kSideOfCells,
                   b = Ball{}.distance(centerOf(high)) / kSideOfCells;
      const auto& lines = closest.crossed()[std::size_t(cell >> 9)][std::size_t(axis)];
      const bool isCrossed = (lines[std::size_t(cell >> 6 & 7)] >> (cell & 63) & 1) != 0;
      if (std::min(std::abs(a), std::abs(b)) < 0.1) continue;
      if (a * b < 0.0) REQUIRE(isCrossed);
      if (a < 0.0 && b < 0.0) REQUIRE_FALSE(isCrossed);
      if (a > 1.0 && b > 1.0) REQUIRE_FALSE(isCrossed);
      crossed += isCrossed;
    }
  CHECK(crossed > 200);
  ClosestTriangles extended(surface, kSideOfCells);
  extended.extend(9.0);
  CHECK(extended.blocks().size() > closest.blocks().size());
  CHECK(extended.crossed() == closest.crossed());
}

TEST_CASE("closest triangles: the same on one thread and on several, and of no surface none", "[caches]") {
  const SurfaceTriangles surface = randomTriangles(300, 0.2);
  ClosestTriangles several(surface, kSideOfCells);
  several.extend(5.0);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  ClosestTriangles alone(surface, kSideOfCells);
  alone.extend(5.0);
  CHECK(alone.blocks().origins == several.blocks().origins);
  CHECK(alone.known() == several.known());
  CHECK(alone.crossed() == several.crossed());
  for (std::int64_t cell = 0; cell < std::int64_t(alone.blocks().voxels()); ++cell) {
    REQUIRE(alone.at(cell).square == several.at(cell).square);
    REQUIRE(alone.at(cell).triangle == several.at(cell).triangle);
  }
  const SurfaceTriangles nothing;
  ClosestTriangles none(nothing, kSideOfCells);
  none.extend(5.0);
  CHECK(none.blocks().size() == 0);
}
