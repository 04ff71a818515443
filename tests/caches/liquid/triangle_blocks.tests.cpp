#include "caches/liquid/triangle_blocks.h"

#include "tests/caches/liquid/surfaces.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

std::set<std::array<int, 3>> blocksOf(const TriangleBlocks& blocks, std::uint32_t triangle) {
  std::set<std::array<int, 3>> found;
  for (std::size_t n = 0; n < blocks.blocks.size(); ++n)
    for (const std::uint32_t t : blocks.of(n))
      if (t == triangle) found.insert({blocks.blocks[n][0], blocks.blocks[n][1], blocks.blocks[n][2]});
  return found;
}

// The blocks with a cell within `reach` cells of the triangle: by all cells of a box.
std::set<std::array<int, 3>> blocksWithin(const CellTriangles& surface, std::uint32_t triangle, double reach,
                                          int box) {
  std::set<std::array<int, 3>> found;
  for (int i = -box; i < box; ++i)
    for (int j = -box; j < box; ++j)
      for (int k = -box; k < box; ++k) {
        if (closestPoint(surface, triangle, Vec3d(i, j, k)).square > reach * reach) continue;
        const auto block = [](int cell) { return cell >> 3; };
        found.insert({block(i), block(j), block(k)});
      }
  return found;
}

}  // namespace

TEST_CASE("triangle blocks: all that have cells near a triangle, and of those around a long one no more",
          "[caches]") {
  SurfaceTriangles given = randomTriangles(12, 0.8);
  for (Vec3f& x : given.points) x *= 20.0f;
  // From corner to corner of a box of 4^3 blocks, thin.
  given.points.insert(given.points.end(), {Vec3f(-5.0f), Vec3f(26.0f), Vec3f(26.0f, 25.0f, 26.0f)});
  given.triangles.emplace_back(36, 37, 38);
  const CellTriangles surface = cellTriangles(given, 1.0);
  for (const double reach : {0.0, 2.0, 5.0}) {
    const TriangleBlocks blocks = trianglesByBlock(surface, reach);
    for (std::uint32_t t = 0; t < 13; ++t) {
      CAPTURE(reach, t);
      const auto found = blocksOf(blocks, t), needed = blocksWithin(surface, t, reach, 40);
      CHECK(std::includes(found.begin(), found.end(), needed.begin(), needed.end()));
      if (t == 12) CHECK(found.size() <= 2 * needed.size());
    }
  }
}

TEST_CASE("triangle blocks: in the order of the triangles, each block once, its triangles ascending",
          "[caches]") {
  SurfaceTriangles given = surfaceOfBall({}, 5);
  const CellTriangles surface = cellTriangles(given, 0.01);
  const TriangleBlocks blocks = trianglesByBlock(surface, 2.0);
  REQUIRE(surface.triangles.size() > 4096);  // that one task takes
  REQUIRE(blocks.first.size() == blocks.blocks.size() + 1);
  CHECK(blocks.first.front() == 0);
  CHECK(blocks.first.back() == blocks.triangles.size());
  CHECK(std::set<Coord>(blocks.blocks.begin(), blocks.blocks.end()).size() == blocks.blocks.size());
  std::uint32_t last = 0;
  for (std::size_t n = 0; n < blocks.blocks.size(); ++n) {
    const auto some = blocks.of(n);
    REQUIRE_FALSE(some.empty());
    CHECK(some.front() >= last);
    last = some.front();
    CHECK(std::adjacent_find(some.begin(), some.end(), std::greater_equal<>()) == some.end());
  }
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const TriangleBlocks again = trianglesByBlock(surface, 2.0);
  CHECK(again.blocks == blocks.blocks);
  CHECK(again.triangles == blocks.triangles);
}

TEST_CASE("triangle blocks: triangles that count for nothing are in none", "[caches]") {
  const SurfaceTriangles flat{{Vec3f(0.0f), Vec3f(1.0f), Vec3f(2.0f), Vec3f(std::nanf(""), 0.0f, 0.0f)},
                              {Vec3I(0, 1, 2), Vec3I(0, 1, 3), Vec3I(0, 0, 1)}};
  CHECK(trianglesByBlock(cellTriangles(flat, 0.1), 2.0).blocks.empty());
  const TriangleBlocks none = trianglesByBlock(cellTriangles({}, 0.1), 2.0);
  CHECK(none.blocks.empty());
  CHECK(none.first == std::vector<std::uint32_t>{0});
}
