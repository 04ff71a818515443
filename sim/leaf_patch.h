// A leaf's values with those next to its six faces, from flat arrays of 512 values a leaf: for stencils of a
// cell and its neighbours.
#pragma once

#include "sim/leaf_table.h"

#include <algorithm>
#include <array>
#include <vector>

namespace fluidtex::sim {

inline constexpr int kPatchSide = kLeafDim + 2;
inline constexpr int kPatchStride[3] = {kPatchSide * kPatchSide, kPatchSide, 1};
using LeafPatch = std::array<float, kPatchSide * kPatchSide * kPatchSide>;  // its edges stay unset

// Where the voxel at an offset of the leaf is in its patch.
inline int patchIndex(int offset) {
  return ((offset >> 6) + 1) * kPatchStride[0] + (((offset >> 3) & 7) + 1) * kPatchStride[1] + (offset & 7) +
         1;
}

// values: of all leaves. Where there is no next leaf, what `outside` makes of the value in this one.
template <class Outside>
void loadPatch(const LeafTable& leaves, const std::vector<float>& values, std::size_t leaf, LeafPatch& patch,
               const Outside& outside) {
  const float* own = values.data() + leaf * kLeafSize;
  for (int row = 0; row < kLeafSize; row += kLeafDim)
    std::copy_n(own + row, kLeafDim, &patch[patchIndex(row)]);
  for (int direction = 0; direction < 6; ++direction) {
    const int axis = direction >> 1, up = direction & 1, shift = 6 - 3 * axis;
    const std::int32_t next = leaves.next[leaf][direction];
    const float* there = next < 0 ? nullptr : values.data() + std::size_t(next) * kLeafSize;
    for (int n = 0; n < kLeafDim * kLeafDim; ++n) {
      const int low = axis == 0 ? n : (axis == 1 ? (n >> 3) * 64 + (n & 7) : 8 * n);
      const int edge = low + (up != 0 ? 7 << shift : 0), beyond = low + (up != 0 ? 0 : 7 << shift);
      patch[patchIndex(edge) + (up != 0 ? kPatchStride[axis] : -kPatchStride[axis])] =
          there != nullptr ? there[beyond] : outside(own[edge]);
    }
  }
}

}  // namespace fluidtex::sim
