// The leaves of a tree as a numbered list with neighbours, for kernels that visit voxels in an order of their
// own, on flat arrays of 512 values a leaf.
#pragma once

#include "sim/grid/mac_grid.h"

#include <cstdint>

namespace fluidtex::sim {

struct LeafTable {
  std::vector<Coord> origins;  // #leaves, in the tree's order
  std::vector<std::array<std::int32_t, 6>>
      next;  // the leaf towards -x, +x, -y, +y, -z, +z; -1 where there is none

  std::size_t size() const { return origins.size(); }
  std::size_t voxels() const { return origins.size() * kLeafSize; }

  // The neighbour of a voxel (leaf * 512 + offset) towards direction 0..5 (as in `next`), or -1.
  std::int64_t neighbor(std::int64_t voxel, int direction) const {
    const int axis = direction >> 1, up = direction & 1;
    const int shift = 6 - 3 * axis;  // x: 64, y: 8, z: 1
    const int at = static_cast<int>(voxel >> shift) & 7;
    if (at != (up != 0 ? 7 : 0)) return voxel + (up != 0 ? (1 << shift) : -(1 << shift));
    const std::int64_t leaf = next[static_cast<std::size_t>(voxel >> 9)][static_cast<std::size_t>(direction)];
    if (leaf < 0) return -1;
    const std::int64_t offset = (voxel & 511) + (up != 0 ? -(7 << shift) : (7 << shift));
    return leaf * kLeafSize + offset;
  }

  Coord coord(std::int64_t voxel) const {
    const int n = static_cast<int>(voxel & 511);
    return origins[static_cast<std::size_t>(voxel >> 9)].offsetBy(n >> 6, (n >> 3) & 7, n & 7);
  }
};

LeafTable makeLeafTable(const FloatTree& tree);

// The values of a tree on these leaves; where it has no leaf, its tile or background value.
std::vector<float> sampleOn(const LeafTable& table, const FloatTree& tree);

// The tree's 512 values of a leaf block: the leaf's buffer, or `scratch` (512 floats) filled with the tile's
// value.
const float* leafValues(const FloatTree& tree, const Coord& origin, float* scratch);

// Origins, sorted, of the leaves touching the box where phi has a leaf or is inside: all liquid, and the
// narrow band.
std::vector<Coord> wetLeaves(const FloatGrid& phi, const CoordBBox& within);

}  // namespace fluidtex::sim
