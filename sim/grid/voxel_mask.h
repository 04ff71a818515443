// Masks of one bit a voxel on the leaves of a table: where a kernel has work, found for 64 voxels at a time.
#pragma once

#include "sim/grid/leaf_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace fluidtex::sim {

// A leaf's 512 voxels: voxel 64 i + n is bit n of word i.
using LeafBits = std::array<std::uint64_t, kLeafSize / 64>;

// #leaves of the table.
using VoxelMask = std::vector<LeafBits>;

inline bool isSet(const VoxelMask& mask, std::int64_t voxel) {
  return (mask[static_cast<std::size_t>(voxel >> 9)][voxel >> 6 & 7] >> (voxel & 63) & 1) != 0;
}

inline void setBit(LeafBits& bits, std::int64_t voxel) {
  bits[voxel >> 6 & 7] |= std::uint64_t{1} << (voxel & 63);
}

inline bool allSet(const LeafBits& bits) {
  return std::all_of(bits.begin(), bits.end(), [](std::uint64_t word) { return word == ~std::uint64_t{0}; });
}

// Calls body(leaf) for all leaves, in parallel.
template <typename Body>
void forLeaves(const LeafTable& table, const Body& body) {
  tbb::parallel_for(std::size_t{0}, table.size(), body);
}

// Calls body(voxel) for the set voxels of one leaf.
template <typename Body>
void forBits(const LeafBits& bits, std::size_t leaf, const Body& body) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    for (std::uint64_t word = bits[i]; word != 0; word &= word - 1)
      body(static_cast<std::int64_t>(leaf * kLeafSize + 64 * i) + std::countr_zero(word));
  }
}

// The voxels where test(value) holds. values: #voxels.
template <typename Test>
VoxelMask maskOf(const LeafTable& table, const std::vector<float>& values, const Test& test) {
  VoxelMask mask(table.size());
  forLeaves(table, [&](std::size_t n) {
    const float* value = values.data() + n * kLeafSize;
    for (std::size_t i = 0; i < mask[n].size(); ++i) {
      std::uint64_t word = 0;
      for (int bit = 0; bit < 64; ++bit) word |= std::uint64_t{test(value[64 * i + bit])} << bit;
      mask[n][i] = word;
    }
  });
  return mask;
}

// A leaf's voxels whose neighbour towards direction 0..5 (as in LeafTable::next) is set.
LeafBits besideThose(const LeafTable& table, const VoxelMask& mask, std::size_t leaf, int direction);

// A leaf's voxels with any neighbour that is set.
LeafBits besideAny(const LeafTable& table, const VoxelMask& mask, std::size_t leaf);

}  // namespace fluidtex::sim
