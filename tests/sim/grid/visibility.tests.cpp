#include "sim/grid/visibility.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <array>
#include <memory>
#include <utility>
#include <vector>

using namespace fluidtex;
using namespace fluidtex::sim;
using openvdb::CoordBBox;
using openvdb::Vec3f;

namespace {

constexpr int atWay(int i, int j, int k) {
  return VisibleCells::kMiddle + i * VisibleCells::kStride[0] + j * VisibleCells::kStride[1] +
         k * VisibleCells::kStride[2];
}

VisibleCells without(std::initializer_list<int> hidden) {
  VisibleCells visible;
  for (const int at : hidden) visible.hide(at);
  return visible;
}

// Whether every cell from which trilinear interpolation at a place reads a sample is visible.
bool readsVisible(const VisibleCells& visible, const Vec3f& place, int axis) {
  for (int corner = 0; corner < 8; ++corner) {
    int way[3] = {0, 0, 0};
    for (int a = 0; a < 3; ++a)
      if ((corner >> a & 1) != 0 && a != axis && place[a] != 0.0f) way[a] = place[a] < 0.0f ? -1 : 1;
    if (!visible.sees(atWay(way[0], way[1], way[2]))) return false;
  }
  return true;
}

// Of the block from (8, -8, 0) on, of which one cell does not see one that is two away along x.
const Coord kBlock(8, -8, 0), kCell(11, -3, 7), kHidden(13, -3, 6);

Visibility oneHidden() {
  auto leaf = std::make_unique<Visibility::Leaf>();
  (*leaf)[3 * 64 + 5 * 8 + 7].hide(atWay(2, 0, -1));
  (*leaf)[0].setInSolid();
  Visibility visibility;
  visibility.add(kBlock, std::move(leaf));
  return visibility;
}

}  // namespace

TEST_CASE("visibility of cells: where all near cells are seen, a place stays where it is", "[sim]") {
  const Vec3f place(0.5f, -0.25f, 0.125f);
  CHECK(moveToOwnSide({}, place) == place);
  // No sample beside a place comes from as far as that.
  CHECK(moveToOwnSide(without({atWay(2, 0, 0), atWay(-2, 1, 0), atWay(0, 0, 2)}), place) == place);
}

TEST_CASE("visibility of cells: a place moves away from a hidden cell, and only along the axis to it",
          "[sim]") {
  const VisibleCells visible = without({atWay(1, 0, 0)});
  CHECK(moveToOwnSide(visible, {0.25f, 0.5f, -0.125f}) == Vec3f(0.0f, 0.5f, -0.125f));
  // On the other side of the centre the hidden cell's sample is not read.
  CHECK(moveToOwnSide(visible, {-0.25f, 0.5f, -0.125f}) == Vec3f(-0.25f, 0.5f, -0.125f));
  CHECK(moveToOwnSide(visible, {0.0f, 0.5f, -0.125f}) == Vec3f(0.0f, 0.5f, -0.125f));
  CHECK(moveToOwnSide(without({atWay(0, 0, -1)}), {0.25f, 0.5f, -0.125f}) == Vec3f(0.25f, 0.5f, 0.0f));
}

TEST_CASE("visibility of cells: of several axes a place moves along that on which it is farthest", "[sim]") {
  const VisibleCells edge = without({atWay(1, -1, 0)});
  CHECK(moveToOwnSide(edge, {0.375f, -0.25f, 0.5f}) == Vec3f(0.0f, -0.25f, 0.5f));
  CHECK(moveToOwnSide(edge, {0.25f, -0.375f, 0.5f}) == Vec3f(0.25f, 0.0f, 0.5f));
  CHECK(moveToOwnSide(edge, {0.25f, 0.375f, 0.5f}) == Vec3f(0.25f, 0.375f, 0.5f));
  const VisibleCells corner = without({atWay(-1, -1, 1)});
  CHECK(moveToOwnSide(corner, {-0.125f, -0.25f, 0.375f}) == Vec3f(-0.125f, -0.25f, 0.0f));
  // Both neighbours along x and y are hidden, too, so nothing is left but along z.
  const VisibleCells pit = without({atWay(1, 0, 0), atWay(0, 1, 0), atWay(1, 1, 0)});
  CHECK(moveToOwnSide(pit, {0.25f, 0.125f, 0.375f}) == Vec3f(0.0f, 0.0f, 0.375f));
}

TEST_CASE("visibility of cells: samples at faces are read from the cell's own two", "[sim]") {
  CHECK(moveToOwnSide({}, {0.75f, 0.75f, -0.75f}, 0) == Vec3f(0.5f, 0.75f, -0.75f));
  CHECK(moveToOwnSide({}, {0.75f, 0.75f, -0.75f}, 2) == Vec3f(0.75f, 0.75f, -0.5f));
  const VisibleCells visible = without({atWay(1, 0, 0), atWay(0, 1, 0)});
  CHECK(moveToOwnSide(visible, {0.75f, 0.25f, 0.25f}, 0) == Vec3f(0.5f, 0.0f, 0.25f));
  CHECK(moveToOwnSide(visible, {0.25f, 0.25f, 0.25f}, 1) == Vec3f(0.0f, 0.25f, 0.25f));
}

TEST_CASE("visibility of cells: whatever is hidden, no sample of it is read, and none moves without need",
          "[sim]") {
  std::uint64_t counter = 0;
  int moved = 0;
  for (int n = 0; n < 5000; ++n) {
    VisibleCells visible;
    for (int at = 0; at < VisibleCells::kCount; ++at)
      if (at != VisibleCells::kMiddle && randomUnit(5, counter++) < 0.1) visible.hide(at);
    Vec3f place;
    for (int a = 0; a < 3; ++a) place[a] = float(randomUnit(5, counter++) - 0.5);
    const int axis = int(randomBelow(5, counter++, 4)) - 1;
    const Vec3f there = moveToOwnSide(visible, place, axis);
    REQUIRE(readsVisible(visible, there, axis));
    for (int a = 0; a < 3; ++a) REQUIRE((there[a] == place[a] || (there[a] == 0.0f && a != axis)));
    if (readsVisible(visible, place, axis)) REQUIRE(there == place);
    moved += there != place;
  }
  CHECK(moved > 1000);
  CHECK(moved < 4000);
}

TEST_CASE("visibility: without blocks, all see all", "[sim]") {
  const Visibility visibility;
  CHECK(visibility.empty());
  CHECK(visibility.origins().empty());
  CHECK(visibility.leaf(Coord(0)) == nullptr);
  CHECK(visibility.around(kCell) == nullptr);
  CHECK_FALSE(visibility.hides(kCell, kHidden));
  CHECK_FALSE(visibility.touches(CoordBBox(Coord(-100), Coord(100))));
}

TEST_CASE("visibility: a block's cells are found by their places, below 0 too", "[sim]") {
  const Visibility visibility = oneHidden();
  CHECK_FALSE(visibility.empty());
  CHECK(visibility.origins() == std::vector<Coord>{kBlock});
  REQUIRE(visibility.leaf(kBlock) != nullptr);
  CHECK(visibility.leaf(Coord(8, 0, 0)) == nullptr);
  CHECK(visibility.around(kCell) == &(*visibility.leaf(kBlock))[3 * 64 + 5 * 8 + 7]);
  // Null where all around is seen, in a solid or not, and where there is no block.
  CHECK(visibility.around(kBlock) == nullptr);
  CHECK(visibility.around(kCell.offsetBy(0, 0, -1)) == nullptr);
  CHECK(visibility.around(kCell.offsetBy(0, 8, 0)) == nullptr);
}

TEST_CASE("visibility: blocks are told in the order in which they came", "[sim]") {
  Visibility visibility = oneHidden();
  auto leaf = std::make_unique<Visibility::Leaf>();
  (*leaf)[0].hide(atWay(0, 1, 0));
  visibility.add(Coord(-16, 0, 800), std::move(leaf));
  CHECK(visibility.origins() == std::vector<Coord>{kBlock, Coord(-16, 0, 800)});
  CHECK(visibility.hides(Coord(-16, 0, 800), Coord(-16, 1, 800)));
  CHECK(visibility.hides(kCell, kHidden));
}

TEST_CASE("visibility: a cell is hidden from the one that does not see it, and from no other", "[sim]") {
  const Visibility visibility = oneHidden();
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k) {
        const Coord cell = kCell.offsetBy(i, j, k);
        REQUIRE(visibility.hides(kCell, cell) == (cell == kHidden));
      }
  CHECK_FALSE(visibility.hides(kHidden, kCell));
  // One cell less along x is as far in the list as five cells more along y.
  CHECK(atWay(2, 0, -1) == atWay(1, 5, -1));
  CHECK_FALSE(visibility.hides(kCell, kCell.offsetBy(1, 5, -1)));
}

TEST_CASE("visibility: a box touches the blocks that it has a cell of", "[sim]") {
  const Visibility visibility = oneHidden();
  const Coord last = kBlock.offsetBy(7, 7, 7);
  CHECK(visibility.touches(CoordBBox(kBlock, kBlock)));
  CHECK(visibility.touches(CoordBBox(last, last)));
  CHECK(visibility.touches(CoordBBox(last, last.offsetBy(30, 30, 30))));
  CHECK(visibility.touches(CoordBBox(kBlock.offsetBy(-30, -30, -30), kBlock)));
  for (int a = 0; a < 3; ++a) {
    Coord low = kBlock, high = last;
    low[a] = last[a] + 1;
    high[a] = last[a] + 20;
    CHECK_FALSE(visibility.touches(CoordBBox(low, high)));
    low[a] = kBlock[a] - 20;
    high[a] = kBlock[a] - 1;
    CHECK_FALSE(visibility.touches(CoordBBox(low, high)));
  }
}
