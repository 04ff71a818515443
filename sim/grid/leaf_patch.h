// A leaf's values with those next to its six faces, from flat arrays of 512 values a leaf: for stencils of a
// cell and its neighbours.
#pragma once

#include "sim/grid/leaf_block.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"

#include <algorithm>
#include <array>
#include <vector>

namespace fluidtex::sim {

using LeafPatch = LeafBlock<1>;  // its edges stay unset
inline constexpr auto& kPatchStride = LeafPatch::kStride;

// Index in the patch of the voxel at an offset of the leaf.
inline int patchIndex(int offset) {
  return LeafPatch::index(offset);
}

// The patch of a leaf of a tree.
inline LeafPatch patchOf(const FloatTree& tree, const Coord& origin) {
  LeafPatch patch{};
  patch.load(tree, origin, true);
  return patch;
}

// The layer of values next to a leaf's face `up` (0: the lower one, 1: the upper one) along kAxis.
template <int kAxis, class Outside>
void loadFace(const LeafTable& leaves, const std::vector<float>& values, std::size_t leaf, int up,
              LeafPatch& patch, const Outside& outside) {
  constexpr int kShift = 6 - 3 * kAxis;
  const float* own = values.data() + leaf * kLeafSize;
  const std::int32_t next = leaves.next[leaf][2 * kAxis + up];
  const float* there = next < 0 ? nullptr : values.data() + std::size_t(next) * kLeafSize;
  const int edge = up != 0 ? 7 << kShift : 0, beyond = up != 0 ? 0 : 7 << kShift;
  const int out = up != 0 ? kPatchStride[kAxis] : -kPatchStride[kAxis];
  for (int i = 0; i < kLeafDim; ++i) {
    for (int j = 0; j < kLeafDim; ++j) {
      const int low = kAxis == 0 ? 8 * i + j : (kAxis == 1 ? 64 * i + j : 64 * i + 8 * j);
      patch[patchIndex(low + edge) + out] = there != nullptr ? there[low + beyond] : outside(own[low + edge]);
    }
  }
}

// Loads a leaf's values and those next to its faces along kAxis; the rest is unchanged.
template <int kAxis, class Outside>
void loadPatchAlong(const LeafTable& leaves, const std::vector<float>& values, std::size_t leaf,
                    LeafPatch& patch, const Outside& outside) {
  const float* own = values.data() + leaf * kLeafSize;
  for (int row = 0; row < kLeafSize; row += kLeafDim)
    std::copy_n(own + row, kLeafDim, &patch[patchIndex(row)]);
  for (const int up : {0, 1}) loadFace<kAxis>(leaves, values, leaf, up, patch, outside);
}

// Loads a leaf's values and those next to its six faces. values: of all leaves. Where there is no next leaf:
// outside(the value in this one).
template <class Outside>
void loadPatch(const LeafTable& leaves, const std::vector<float>& values, std::size_t leaf, LeafPatch& patch,
               const Outside& outside) {
  loadPatchAlong<0>(leaves, values, leaf, patch, outside);
  for (const int up : {0, 1}) {
    loadFace<1>(leaves, values, leaf, up, patch, outside);
    loadFace<2>(leaves, values, leaf, up, patch, outside);
  }
}

}  // namespace fluidtex::sim
