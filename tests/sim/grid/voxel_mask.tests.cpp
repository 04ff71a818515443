#include "sim/grid/voxel_mask.h"

#include <catch2/catch.hpp>

#include <random>

using namespace fluidtex::sim;

namespace {

// Leaves some of which touch, on both sides of 0.
LeafTable someLeaves() {
  FloatTree tree(0.0f);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        if ((i + 2 * j + 3 * k) % 4 != 0) tree.touchLeaf(Coord(8 * i, 8 * j, 8 * k));
      }
    }
  }
  return makeLeafTable(tree);
}

std::vector<float> randomValues(const LeafTable& table) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  std::vector<float> values(table.voxels());
  for (float& v : values) v = value(random);
  return values;
}

}  // namespace

TEST_CASE("voxel_mask: holds what the test says, and is walked in order") {
  const LeafTable table = someLeaves();
  const std::vector<float> values = randomValues(table);
  const VoxelMask mask = maskOf(table, values, [](float v) { return v < -0.3f; });
  std::vector<std::int64_t> walked, expected;
  for (std::size_t n = 0; n < table.size(); ++n)
    forBits(mask[n], n, [&](std::int64_t voxel) { walked.push_back(voxel); });
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] < -0.3f) expected.push_back(std::int64_t(n));
    if (isSet(mask, std::int64_t(n)) != (values[n] < -0.3f)) FAIL("voxel " << n);
  }
  CHECK(walked == expected);
}

TEST_CASE("voxel_mask: neighbours as the table knows them, also across leaves") {
  const LeafTable table = someLeaves();
  const VoxelMask mask = maskOf(table, randomValues(table), [](float v) { return v < 0.0f; });
  int wrong = 0;
  for (std::size_t leaf = 0; leaf < table.size(); ++leaf) {
    const LeafBits any = besideAny(table, mask, leaf);
    std::array<LeafBits, 6> beside;
    for (int direction = 0; direction < 6; ++direction)
      beside[direction] = besideThose(table, mask, leaf, direction);
    for (int n = 0; n < kLeafSize; ++n) {
      const auto bit = [&](const LeafBits& bits) { return (bits[n / 64] >> (n % 64) & 1) != 0; };
      bool expected = false;
      for (int direction = 0; direction < 6; ++direction) {
        const std::int64_t next = table.neighbor(std::int64_t(leaf) * kLeafSize + n, direction);
        const bool there = next >= 0 && isSet(mask, next);
        if (bit(beside[direction]) != there) ++wrong;
        expected = expected || there;
      }
      if (bit(any) != expected) ++wrong;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("voxel_mask: a leaf is full when each of its voxels is set") {
  LeafBits bits{};
  for (int n = 0; n < kLeafSize; ++n) {
    CHECK_FALSE(allSet(bits));
    setBit(bits, 5 * kLeafSize + n);
  }
  CHECK(allSet(bits));
}
