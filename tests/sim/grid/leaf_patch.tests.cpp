#include "sim/grid/leaf_patch.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

// Three leaves in a row along x, and values that tell each voxel.
FloatTree row() {
  FloatTree tree(0.0f);
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k) tree.setValue(Coord(i, j, k), float(100 * i + 10 * j + k));
  return tree;
}

}  // namespace

TEST_CASE("leaf patch: own values, the next leaf's, and beyond it what is asked for", "[sim]") {
  const FloatTree tree = row();
  const LeafTable table = makeLeafTable(tree);
  const std::vector<float> values = sampleOn(table, tree);
  LeafPatch patch{};
  loadPatch(table, values, 0, patch, [](float inside) { return -inside; });
  for (int offset = 0; offset < kLeafSize; ++offset) {
    const int local[3] = {offset >> 6, (offset >> 3) & 7, offset & 7}, at = patchIndex(offset);
    REQUIRE(patch[at] == values[offset]);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int up : {0, 1}) {
        if (local[axis] != (up != 0 ? 7 : 0)) continue;
        Coord beside = table.coord(offset);
        beside[axis] += up != 0 ? 1 : -1;
        const bool next = axis == 0 && up == 1;
        const float there = patch[at + (up != 0 ? 1 : -1) * kPatchStride[axis]];
        REQUIRE(there == (next ? tree.getValue(beside) : -values[offset]));
      }
    }
  }
}

TEST_CASE("leaf patch: along one axis the others' faces are left as they are", "[sim]") {
  const FloatTree tree = row();
  const LeafTable table = makeLeafTable(tree);
  LeafPatch patch{};
  patch.fill(-7.0f);
  loadPatchAlong<0>(table, sampleOn(table, tree), 1, patch, [](float) { return 0.0f; });
  CHECK(patch[LeafPatch::index(-1, 2, 3)] == tree.getValue(Coord(7, 2, 3)));
  CHECK(patch[LeafPatch::index(8, 2, 3)] == tree.getValue(Coord(16, 2, 3)));
  CHECK(patch[LeafPatch::index(2, -1, 3)] == -7.0f);
  CHECK(patch[LeafPatch::index(2, 3, 8)] == -7.0f);
}

TEST_CASE("leaf patch: of a tree, what a stencil of a cell and its six neighbours reads", "[sim]") {
  const FloatTree tree = row();
  const LeafPatch patch = patchOf(tree, Coord(8, 0, 0));
  for (const Coord& c : {Coord(0, 0, 0), Coord(-1, 4, 4), Coord(8, 4, 4), Coord(4, -1, 4), Coord(4, 4, 8)})
    CHECK(patch[LeafPatch::index(c[0], c[1], c[2])] == tree.getValue(c.offsetBy(8, 0, 0)));
}
