#include "caches/liquid/triangle_raster.h"

#include "numerics/random.h"
#include "sim/grid/mac_grid.h"
#include "tests/caches/liquid/flows.h"

#include <openvdb/math/Proximity.h>

#include <catch2/catch.hpp>

#include <bit>
#include <limits>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

constexpr float kNothing = std::numeric_limits<float>::max();
constexpr std::uint32_t kNoTriangle = ~0u;

BlockNearest emptyBlock() {
  BlockNearest nearest;
  nearest.square.fill(kNothing);
  nearest.triangle.fill(kNoTriangle);
  return nearest;
}

Vec3d cellPlace(int cell) {
  return Vec3d(cell >> 6, cell >> 3 & 7, cell & 7);
}

double distanceTo(const BlockTriangle& t, const Vec3d& x) {
  Vec3d weight;
  return (openvdb::math::closestPointOnTriangleToPoint(t[0], t[1], t[2], x, weight) - x).length();
}

// Corners up to `size` apart, around the block.
BlockTriangle randomTriangle(std::uint64_t n, double size) {
  const auto at = [&](std::uint64_t k) {
    return Vec3d(randomUnit(5, 12 * n + 3 * k), randomUnit(5, 12 * n + 3 * k + 1),
                 randomUnit(5, 12 * n + 3 * k + 2));
  };
  const Vec3d middle = Vec3d(-4.0) + 16.0 * at(0);
  return {middle + size * (at(1) - Vec3d(0.5)), middle + size * (at(2) - Vec3d(0.5)),
          middle + size * (at(3) - Vec3d(0.5))};
}

bool isCrossedAt(const CrossedLines& crossed, int axis, int cell) {
  return (crossed[std::size_t(axis)][std::size_t(cell >> 6)] >> (cell & 63) & 1) != 0;
}

int crossedCount(const CrossedLines& crossed) {
  int count = 0;
  for (const auto& bits : crossed)
    for (const std::uint64_t word : bits) count += std::popcount(word);
  return count;
}

// How far inside of the triangle, seen along the axis, a line through x goes, over the triangle's size; and
// where it meets its plane, up the axis from x.
struct Passing {
  double inside = 0.0, height = 0.0;
};

Passing passing(const BlockTriangle& t, int axis, const Vec3d& x) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto area = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
  };
  const double all = area(t[0], t[1], t[2]);
  const double w[3] = {area(x, t[1], t[2]) / all, area(t[0], x, t[2]) / all, area(t[0], t[1], x) / all};
  return {std::min({w[0], w[1], w[2]}), w[0] * t[0][axis] + w[1] * t[1][axis] + w[2] * t[2][axis] - x[axis]};
}

}  // namespace

TEST_CASE("triangle raster: distances of all cells within the reach", "[caches]") {
  int near = 0;
  double worst = 0.0;
  for (std::uint64_t n = 0; n < 300; ++n) {
    const BlockTriangle triangle = randomTriangle(n, n % 3 == 0 ? 2.0 : 9.0);
    BlockNearest nearest = emptyBlock();
    rasterDistances(triangle, 17, nearest);
    for (int cell = 0; cell < sim::kLeafSize; ++cell) {
      const double distance = distanceTo(triangle, cellPlace(cell));
      const auto at = std::size_t(cell);
      const bool isSet = nearest.triangle[at] == 17;
      REQUIRE((isSet || (nearest.triangle[at] == kNoTriangle && nearest.square[at] == kNothing)));
      if (distance < kRasterReach - 1e-4) REQUIRE(isSet);
      if (!isSet) continue;
      worst = std::max(worst, std::abs(std::sqrt(nearest.square[at]) - distance));
      near += distance < kRasterReach;
    }
  }
  CHECK(near > 5000);
  CHECK(worst < 2e-3);
}

TEST_CASE("triangle raster: the closest of several stays, whatever their order", "[caches]") {
  std::vector<BlockTriangle> triangles;
  for (std::uint64_t n = 0; n < 20; ++n) triangles.push_back(randomTriangle(1000 + n, 6.0));
  BlockNearest up = emptyBlock(), down = emptyBlock();
  for (std::uint32_t n = 0; n < 20; ++n) {
    rasterDistances(triangles[n], n, up);
    rasterDistances(triangles[19 - n], 19 - n, down);
  }
  CHECK(up.square == down.square);
  for (int cell = 0; cell < sim::kLeafSize; ++cell) {
    double closest = 1e9;
    for (const BlockTriangle& t : triangles) closest = std::min(closest, distanceTo(t, cellPlace(cell)));
    if (closest > kRasterReach - 1e-4) continue;
    const std::uint32_t number = up.triangle[std::size_t(cell)];
    REQUIRE(number < 20);
    CHECK(distanceTo(triangles[number], cellPlace(cell)) == Approx(closest).margin(1e-3));
  }
  // As near as what is there: that stays.
  BlockNearest twice = emptyBlock();
  rasterDistances(triangles[0], 1, twice);
  rasterDistances(triangles[0], 2, twice);
  for (const std::uint32_t number : twice.triangle) CHECK(number != 2);
}

TEST_CASE("triangle raster: slivers, edges and points count by their edges", "[caches]") {
  const Vec3d a(1.3, 2.2, 0.4), b(6.1, 4.9, 6.8);
  for (const BlockTriangle& sliver :
       {BlockTriangle{a, b, 0.5 * (a + b)}, BlockTriangle{a, b, 0.5 * (a + b) + Vec3d(0, 1e-7, 0)},
        BlockTriangle{a, a, b}, BlockTriangle{b, b, b},
        // Beyond its tips lie the centres of cells.
        BlockTriangle{Vec3d(1.3), Vec3d(4.1), Vec3d(2.7) + Vec3d(1e-7, -1e-7, 0)},
        BlockTriangle{Vec3d(1.3, 2.3, 5.7), Vec3d(4.1, 5.1, 2.9), Vec3d(2.7, 3.7 + 1e-7, 4.3)}}) {
    BlockNearest nearest = emptyBlock();
    rasterDistances(sliver, 0, nearest);
    for (int cell = 0; cell < sim::kLeafSize; ++cell) {
      const Vec3d x = cellPlace(cell), low = sliver[0],
                  along = sliver[1] == low ? sliver[2] - low : sliver[1] - low;
      const double t =
          along.lengthSqr() > 0.0 ? std::clamp((x - low).dot(along) / along.lengthSqr(), 0.0, 1.0) : 0.0;
      const double distance = (x - low - t * along).length();
      if (distance < kRasterReach)
        CHECK(std::sqrt(nearest.square[std::size_t(cell)]) == Approx(distance).margin(1e-4));
    }
  }
}

TEST_CASE("triangle raster: the lines that a triangle goes through, and no others", "[caches]") {
  int hit = 0;
  for (std::uint64_t n = 0; n < 300; ++n) {
    CAPTURE(n);
    const BlockTriangle triangle = randomTriangle(n, n % 2 == 0 ? 5.0 : 20.0);
    CrossedLines crossed{};
    rasterCrossings(triangle, crossed);
    for (int axis = 0; axis < 3; ++axis)
      for (int cell = 0; cell < sim::kLeafSize; ++cell) {
        const auto [inside, height] = passing(triangle, axis, cellPlace(cell));
        const double depth = std::min({inside, height, 1.0 - height});
        if (depth > 1e-4) REQUIRE(isCrossedAt(crossed, axis, cell));
        if (depth < -1e-4) REQUIRE_FALSE(isCrossedAt(crossed, axis, cell));
        hit += depth > 1e-4;
      }
  }
  CHECK(hit > 1500);
}

TEST_CASE("triangle raster: a plane through centres, and edges along lines, are touched", "[caches]") {
  // At x = 3, with a corner at the centre of cell (3, 2, 2) and edges along the lines from it.
  const BlockTriangle side{Vec3d(3, 2, 2), Vec3d(3, 5, 2), Vec3d(3, 2, 5)};
  CrossedLines crossed{};
  rasterCrossings(side, crossed);
  const auto at = [](int i, int j, int k) { return 64 * i + 8 * j + k; };
  for (const int j : {2, 3, 4, 5})
    for (int k = 2; j + k <= 7; ++k) {
      CAPTURE(j, k);
      // Both lines that end there.
      CHECK(isCrossedAt(crossed, 0, at(2, j, k)));
      CHECK(isCrossedAt(crossed, 0, at(3, j, k)));
      CHECK(isCrossedAt(crossed, 1, at(3, j, k)));
      CHECK(isCrossedAt(crossed, 2, at(3, j, k)));
    }
  CHECK_FALSE(isCrossedAt(crossed, 0, at(3, 1, 2)));
  CHECK_FALSE(isCrossedAt(crossed, 0, at(3, 5, 5)));
  CHECK_FALSE(isCrossedAt(crossed, 0, at(4, 3, 3)));
  CHECK_FALSE(isCrossedAt(crossed, 0, at(1, 3, 3)));
  // It is missed by less than a millionth of a cell.
  CrossedLines missed{};
  rasterCrossings({Vec3d(4.5, 2 + 5e-7, 1), Vec3d(4.5, 6, 1), Vec3d(4.5, 2 + 5e-7, 3)}, missed);
  CHECK(isCrossedAt(missed, 0, at(4, 2, 2)));
}

TEST_CASE("triangle raster: nothing slips through where triangles share edges and corners", "[caches]") {
  // A plane that is oblique to all lines, cut into triangles whose corners are at random.
  for (std::uint64_t n = 0; n < 50; ++n) {
    CAPTURE(n);
    const auto number = [&](std::uint64_t k) { return randomUnit(9, 20 * n + k); };
    const Vec3d normal = Vec3d(0.2 + number(0), 0.2 + number(1), 0.2 + number(2)).unit(), middle(3.5);
    const Vec3d along = normal.cross(Vec3d(1, 0, 0)).unit(), up = normal.cross(along);
    // The centre lies on a corner of all of them, and on a cell's centre.
    const Vec3d center = n % 2 == 0 ? Vec3d(3, 4, 3) : middle;
    CrossedLines crossed{};
    std::vector<Vec3d> rim;
    for (int k = 0; k < 7; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.7 * number(10 + std::uint64_t(k))) / 7.0;
      rim.push_back(center + 40.0 * (std::cos(angle) * along + std::sin(angle) * up));
    }
    for (std::size_t k = 0; k < 7; ++k) rasterCrossings({center, rim[k], rim[(k + 1) % 7]}, crossed);
    for (int axis = 0; axis < 3; ++axis)
      for (int cell = 0; cell < sim::kLeafSize; ++cell) {
        Vec3d next = cellPlace(cell);
        next[axis] += 1.0;
        const double here = normal.dot(cellPlace(cell) - center), there = normal.dot(next - center);
        if (here * there <= 0.0) REQUIRE(isCrossedAt(crossed, axis, cell));
        if (std::min(std::abs(here), std::abs(there)) > 1e-4 && here * there > 0.0)
          REQUIRE_FALSE(isCrossedAt(crossed, axis, cell));
      }
  }
}

TEST_CASE("triangle raster: what is beside the block leaves it as it is", "[caches]") {
  for (const Vec3d& off : {Vec3d(20, 0, 0), Vec3d(0, -20, 0), Vec3d(0, 0, 11)}) {
    BlockNearest nearest = emptyBlock();
    CrossedLines crossed{};
    const BlockTriangle triangle{off, off + Vec3d(0, 1, 0), off + Vec3d(1, 0, 1)};
    rasterDistances(triangle, 0, nearest);
    rasterCrossings(triangle, crossed);
    CHECK(nearest.square == emptyBlock().square);
    CHECK(crossedCount(crossed) == 0);
  }
}
