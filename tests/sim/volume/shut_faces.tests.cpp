#include "sim/volume/shut_faces.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

// Two blocks of cells side by side in x, all open.
struct Blocks {
  LeafTable leaves;
  std::vector<float> room;
  FaceGrids open;

  Blocks() {
    FloatTree tree(0.0f);
    tree.touchLeaf(Coord(0));
    tree.touchLeaf(Coord(8, 0, 0));
    leaves = makeLeafTable(tree);
    room.assign(leaves.voxels(), 1.0f);
    for (auto& component : open.component) component = FloatGrid::create(1.0f);
  }

  // Of the cell: by leaf and offset.
  float& roomOf(const Coord& cell) {
    return room[std::size_t(cell[0] / 8) * kLeafSize + FloatLeaf::coordToOffset(cell)];
  }
  // Shuts the lower face of a cell; a wall there takes some room.
  void shut(const Coord& cell, int axis) {
    open.component[axis]->tree().setValueOn(cell, 0.0f);
    roomOf(cell) = 0.9f;
  }
  ShutFaces found() const { return shutFaces(leaves, room, open); }
};

}  // namespace

TEST_CASE("shut faces: none where no solid takes room") {
  const Blocks blocks;
  for (const auto& leaf : blocks.found()) CHECK(leaf == nullptr);
}

TEST_CASE("shut faces: a face is shut for the cells on both of its sides, within a leaf and between two") {
  Blocks blocks;
  blocks.shut(Coord(3, 4, 5), 1);
  blocks.shut(Coord(8, 2, 2), 0);
  const ShutFaces shut = blocks.found();
  REQUIRE(shut[0] != nullptr);
  REQUIRE(shut[1] != nullptr);
  CHECK((*shut[0])[FloatLeaf::coordToOffset(Coord(3, 4, 5))] == 1 << 2);
  CHECK((*shut[0])[FloatLeaf::coordToOffset(Coord(3, 3, 5))] == 1 << 3);
  CHECK((*shut[0])[FloatLeaf::coordToOffset(Coord(7, 2, 2))] == 1 << 1);
  CHECK((*shut[1])[FloatLeaf::coordToOffset(Coord(8, 2, 2))] == 1 << 0);
  int sides = 0;
  for (const auto& leaf : shut)
    for (const std::uint8_t bits : *leaf) sides += __builtin_popcount(bits);
  CHECK(sides == 4);
}

TEST_CASE("shut faces: a solid's own cells have no room, and their faces do not count") {
  Blocks blocks;
  blocks.shut(Coord(3, 4, 5), 1);
  blocks.roomOf(Coord(3, 3, 5)) = 0.0f;
  for (const auto& leaf : blocks.found()) CHECK(leaf == nullptr);
}

TEST_CASE("shut faces: sums leave out what comes through them") {
  Blocks blocks;
  blocks.shut(Coord(3, 4, 5), 1);
  const ShutFaces shut = blocks.found();
  int cells = 0;
  forCellsBesideShut(shut, 0, [&](int offset, const auto& sum) {
    ++cells;
    const int at = patchIndex(offset);
    const bool isUpper = offset == int(FloatLeaf::coordToOffset(Coord(3, 4, 5)));
    CHECK(sum([](int, int) { return 1.0f; }) == 5.0f);
    CHECK(sum([&](int, int beside) { return beside == besideIn(at, isUpper ? 2 : 3) ? 1.0f : 0.0f; }) ==
          0.0f);
  });
  CHECK(cells == 2);
  forCellsBesideShut(shut, 1, [&](int, const auto&) { FAIL("the other leaf has none"); });
}
