// A leaf's values with layers of its neighbours' around them in one array, for stencils.
#pragma once

#include "sim/grid/mac_grid.h"

#include <array>
#include <cstddef>

namespace fluidtex::sim {

// (8 + 2 kLayers)^3 values, z fastest.
template <int kLayers>
struct LeafBlock {
  static constexpr int kHalo = kLayers, kSide = kLeafDim + 2 * kHalo, kCount = kSide * kSide * kSide;
  static constexpr int kStride[3] = {kSide * kSide, kSide, 1};

  std::array<float, kCount> value;

  // Index of the leaf's voxel at an offset, and of the one at (i, j, k) from its lowest one.
  static constexpr int index(int offset) { return index(offset >> 6, (offset >> 3) & 7, offset & 7); }
  static constexpr int index(int i, int j, int k) {
    return (i + kHalo) * kStride[0] + (j + kHalo) * kStride[1] + k + kHalo;
  }

  // Loads from a tree, as gather() does. crossOnly: leaves out what is off the leaf along more than one axis.
  void load(const FloatTree& tree, const Coord& origin, bool crossOnly = false) {
    gather(tree, origin, kHalo, value.data(), crossOnly);
  }

  float& operator[](int at) { return value[at]; }
  float operator[](int at) const { return value[at]; }
  static constexpr std::size_t size() { return kCount; }
  float* data() { return value.data(); }
  const float* data() const { return value.data(); }
  auto begin() { return value.begin(); }
  auto end() { return value.end(); }
  auto begin() const { return value.begin(); }
  auto end() const { return value.end(); }
  void fill(float with) { value.fill(with); }
};

}  // namespace fluidtex::sim
