#include "sim/grid/block_samples.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

// 1 at (0, 0, 0), rising by 1, 10 and 100 along x, y and z.
FloatTree slope() {
  FloatTree tree(0.0f);
  for (int i = -4; i < 12; ++i)
    for (int j = -4; j < 12; ++j)
      for (int k = -4; k < 12; ++k) tree.setValue(Coord(i, j, k), float(1 + i + 10 * j + 100 * k));
  return tree;
}

}  // namespace

TEST_CASE("block samples: the tree's values in the block's own coordinates, linear between", "[sim]") {
  BlockSamples samples(3);
  samples.load(slope(), Coord(0));
  CHECK(*samples.sample(0, 0, 0) == 1.0f);
  CHECK(*samples.sample(-3, 10, 2) == 1.0f - 3.0f + 100.0f + 200.0f);
  CHECK_THAT(samples.at(0.5f, 2.25f, -1.75f), WithinAbs(1.0 + 0.5 + 22.5 - 175.0, 1e-3));
  samples.setHalo(1);
  samples.load(slope(), Coord(0), -0.5f);
  CHECK(*samples.sample(8, -1, 8) == -0.5f * (1.0f + 8.0f - 10.0f + 800.0f));
  CHECK_THAT(samples.at(7.5f, 7.5f, 7.5f), WithinAbs(-0.5 * (1.0 + 7.5 * 111.0), 1e-3));
}

TEST_CASE("block samples: whether any of the eight values around is negative", "[sim]") {
  FloatTree tree(1.0f);
  tree.setValue(Coord(3, 4, 5), -1.0f);
  BlockSamples samples(1);
  samples.load(tree, Coord(0));
  CHECK(samples.anyNegative(2.5f, 3.5f, 4.5f));
  CHECK(samples.anyNegative(3.5f, 4.5f, 5.5f));
  CHECK_FALSE(samples.anyNegative(4.5f, 4.5f, 5.5f));
  CHECK_FALSE(samples.anyNegative(1.5f, 3.5f, 4.5f));
}

TEST_CASE("block samples: a cell's range is that of its eight corners", "[sim]") {
  BlockSamples samples(1);
  samples.load(slope(), Coord(0));
  CellRanges ranges;
  ranges.find(samples);
  for (int n = 0; n < kLeafSize; n += 73) {
    const float lowest = *samples.sample(n >> 6, (n >> 3) & 7, n & 7);
    CHECK(ranges.low[n] == lowest);
    CHECK(ranges.high[n] == lowest + 111.0f);
  }
}
