#include "sim/grid/leaf_block.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("leaf block: each place holds the tree's value there, neighbours' and background's too", "[sim]") {
  FloatTree tree(7.0f);
  const Coord origin(8, 0, -8);
  for (int i = 0; i < 24; ++i)
    for (int j = -8; j < 8; ++j)
      for (int k = -8; k < 0; ++k) tree.setValue(Coord(i, j, k), float(100 * i + 10 * j + k));
  LeafBlock<2> block;
  block.load(tree, origin);
  for (int i = -2; i < 10; ++i)
    for (int j = -2; j < 10; ++j)
      for (int k = -2; k < 10; ++k)
        REQUIRE(block[LeafBlock<2>::index(i, j, k)] == tree.getValue(origin.offsetBy(i, j, k)));
  for (int offset = 0; offset < kLeafSize; offset += 37)
    CHECK(block[LeafBlock<2>::index(offset)] ==
          tree.getValue(origin.offsetBy(offset >> 6, (offset >> 3) & 7, offset & 7)));
}

TEST_CASE("leaf block: strides lead to the neighbours", "[sim]") {
  using Block = LeafBlock<1>;
  CHECK(Block::index(1, 2, 3) + Block::kStride[0] == Block::index(2, 2, 3));
  CHECK(Block::index(1, 2, 3) + Block::kStride[1] == Block::index(1, 3, 3));
  CHECK(Block::index(1, 2, 3) - Block::kStride[2] == Block::index(1, 2, 2));
  CHECK(Block::index(-1, -1, -1) == 0);
  CHECK(Block::index(8, 8, 8) == Block::kCount - 1);
}
