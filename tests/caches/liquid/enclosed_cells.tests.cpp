#include "caches/liquid/enclosed_cells.h"

#include "caches/liquid/closest_triangles.h"
#include "numerics/random.h"
#include "tests/caches/liquid/surfaces.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::CoordBBox;

namespace {

struct BlockLines {
  sim::LeafTable blocks;
  std::vector<CrossedLines> crossed;

  void add(const Coord& block) {
    blocks.origins.emplace_back(8 * block[0], 8 * block[1], 8 * block[2]);
    crossed.emplace_back();
  }
  // The line from a cell up an axis. Nothing where its block is not there.
  void cross(const Coord& cell, int axis, bool isCrossed = true) {
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      const Coord off = cell - blocks.origins[n];
      if (std::min({off[0], off[1], off[2]}) < 0 || std::max({off[0], off[1], off[2]}) > 7) continue;
      const int at = 64 * off[0] + 8 * off[1] + off[2];
      auto& word = crossed[n][std::size_t(axis)][std::size_t(at >> 6)];
      const std::uint64_t bit = std::uint64_t{1} << (at & 63);
      word = isCrossed ? word | bit : word & ~bit;
    }
  }
  // All lines out of a box of cells.
  void close(const CoordBBox& box) {
    for (int axis = 0; axis < 3; ++axis)
      for (auto cell = box.begin(); cell; ++cell) {
        Coord below = *cell;
        --below[axis];
        if ((*cell)[axis] == box.max()[axis]) cross(*cell, axis);
        if ((*cell)[axis] == box.min()[axis]) cross(below, axis);
      }
  }
};

std::set<Coord> enclosedIn(const sim::LeafTable& blocks, const EnclosedCells& enclosed) {
  std::set<Coord> cells;
  for (std::int64_t cell = 0; cell < std::int64_t(blocks.voxels()); ++cell)
    if (sim::isSet(enclosed.cells, cell)) cells.insert(blocks.coord(cell));
  return cells;
}

std::set<Coord> enclosedBy(const BlockLines& lines) {
  return enclosedIn(lines.blocks, enclosedCells(lines.blocks, lines.crossed));
}

// The cells of the box to which no way leads from its corner: cell by cell.
std::set<Coord> notReached(const BlockLines& lines, const CoordBBox& box) {
  std::set<std::pair<Coord, int>> closed;
  for (std::size_t n = 0; n < lines.crossed.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      sim::forBits(lines.crossed[n][std::size_t(axis)], n, [&](std::int64_t cell) {
        closed.insert({lines.blocks.coord(cell), axis});
      });
  std::set<Coord> reached{box.min()};
  for (std::vector<Coord> next{box.min()}; !next.empty();) {
    const Coord cell = next.back();
    next.pop_back();
    for (int direction = 0; direction < 6; ++direction) {
      const int axis = direction >> 1;
      Coord there = cell;
      there[axis] += direction & 1 ? 1 : -1;
      if (!box.isInside(there) || closed.contains({direction & 1 ? cell : there, axis})) continue;
      if (reached.insert(there).second) next.push_back(there);
    }
  }
  std::set<Coord> rest;
  for (auto cell = box.begin(); cell; ++cell)
    if (!reached.contains(*cell)) rest.insert(*cell);
  return rest;
}

}  // namespace

TEST_CASE("enclosed cells: those of a closed box, in one block or over several", "[caches]") {
  for (const CoordBBox& box : {CoordBBox(Coord(2, 3, 1), Coord(4, 4, 5)), CoordBBox(Coord(4), Coord(9)),
                               CoordBBox(Coord(0), Coord(7)), CoordBBox(Coord(7), Coord(8))}) {
    CAPTURE(box);
    BlockLines lines;
    for (auto block = CoordBBox(Coord(-1), Coord(1)).begin(); block; ++block) lines.add(*block);
    lines.close(box);
    std::set<Coord> inside;
    for (auto cell = box.begin(); cell; ++cell) inside.insert(*cell);
    CHECK(enclosedBy(lines) == inside);
    // One line that is open.
    lines.cross(box.max(), 1, false);
    CHECK(enclosedBy(lines).empty());
  }
}

TEST_CASE("enclosed cells: nothing without lines, and nothing that only walls surround", "[caches]") {
  CHECK(enclosedBy({}).empty());
  BlockLines lines;
  lines.add(Coord(0));
  CHECK(enclosedBy(lines).empty());
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) lines.cross(Coord(i, j, 3), 2);
  CHECK(enclosedBy(lines).empty());
}

TEST_CASE("enclosed cells: blocks between those that are crossed, in the list or not", "[caches]") {
  // Of 40 x 32 x 48 cells, whose sides go through the blocks around 3 x 2 x 4 blocks.
  const CoordBBox box(Coord(-12, -12, -4), Coord(27, 19, 43)), inner(Coord(-8, -8, 0), Coord(23, 15, 39));
  BlockLines lines;
  for (auto block = CoordBBox(Coord(-2), Coord(6)).begin(); block; ++block) {
    const Coord first(8 * (*block)[0], 8 * (*block)[1], 8 * (*block)[2]);
    const CoordBBox cells(first, first.offsetBy(7));
    if (box.hasOverlap(cells) && !inner.hasOverlap(cells)) lines.add(*block);
  }
  const std::size_t count = lines.blocks.size();
  lines.close(box);
  // A block amid, and one outside, of which nothing is crossed.
  lines.blocks.origins.emplace_back(0, 0, 16);
  lines.blocks.origins.emplace_back(80, 0, 16);
  const EnclosedCells enclosed = enclosedCells(lines.blocks, lines.crossed);
  CHECK(sim::allSet(enclosed.cells[count]));
  CHECK(enclosed.cells[count + 1] == sim::LeafBits{});
  std::set<Coord> cells = enclosedIn(lines.blocks, enclosed);
  std::size_t inBoxes = 0;
  for (const CoordBBox& some : enclosed.boxes)
    for (auto cell = some.begin(); cell; ++cell) {
      ++inBoxes;
      CHECK(inner.isInside(*cell));
      cells.insert(*cell);
    }
  CHECK(inBoxes == inner.volume());  // each once
  CHECK(cells.size() == box.volume());
  for (const Coord& cell : cells) REQUIRE(box.isInside(cell));
}

TEST_CASE("enclosed cells: of lines at random, as by going from cell to cell", "[caches]") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    CAPTURE(seed);
    BlockLines lines;
    std::uint64_t at = 0;
    const auto number = [&] { return randomUnit(seed, at++); };
    for (auto block = CoordBBox(Coord(-2, 0, 1), Coord(1, 2, 4)).begin(); block; ++block)
      if (number() < 0.8) lines.add(*block);
    // Half of them are walls around a place or two, others are open or full of lines.
    for (std::size_t n = 0; n < lines.blocks.size(); ++n) {
      const double share = number() < 0.3 ? 0.0 : 0.55 + 0.45 * number();
      for (int axis = 0; axis < 3; ++axis)
        for (int cell = 0; cell < 512; ++cell)
          if (number() < share) sim::setBit(lines.crossed[n][std::size_t(axis)], cell);
    }
    lines.close(CoordBBox(Coord(-11, 3, 13), Coord(9, 21, 34)));
    lines.blocks.origins.emplace_back(-8, 8, 24);
    if (std::count(lines.blocks.origins.begin(), lines.blocks.origins.end(), Coord(-8, 8, 24)) > 1)
      lines.blocks.origins.pop_back();
    const EnclosedCells enclosed = enclosedCells(lines.blocks, lines.crossed);
    const std::set<Coord> expected = notReached(lines, CoordBBox(Coord(-24, -8, 0), Coord(23, 31, 47)));
    CHECK(expected.size() > 100);
    std::set<Coord> found = enclosedIn(lines.blocks, enclosed);
    for (const Coord& cell : found) REQUIRE(expected.contains(cell));
    for (const CoordBBox& box : enclosed.boxes)
      for (auto cell = box.begin(); cell; ++cell) {
        REQUIRE(expected.contains(*cell));
        found.insert(*cell);
      }
    CHECK(found == expected);
  }
}

TEST_CASE("enclosed cells: of a ball's surface, the cells inside", "[caches]") {
  const Ball ball;
  const double h = 0.01;
  const SurfaceTriangles surface = surfaceOfBall(ball, 5);
  const ClosestTriangles closest(surface, h);
  const EnclosedCells enclosed = enclosedCells(closest.blocks(), closest.crossed());
  std::set<Coord> cells = enclosedIn(closest.blocks(), enclosed);
  for (const CoordBBox& box : enclosed.boxes)
    for (auto cell = box.begin(); cell; ++cell) cells.insert(*cell);
  REQUIRE_FALSE(enclosed.boxes.empty());
  const Coord middle = Coord::floor(ball.center / h);
  for (auto off = CoordBBox(Coord(-24), Coord(24)).begin(); off; ++off) {
    const Coord cell = middle + *off;
    const double distance = ball.distance(h * (cell.asVec3d() + Vec3d(0.5)));
    if (std::abs(distance) > 0.05 * h) REQUIRE(cells.contains(cell) == (distance < 0.0));
  }
}
