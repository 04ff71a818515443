// Voxels in the order of their distance.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// A voxel of a LeafTable and how far it is from where a sweep begins.
struct FarVoxel {
  std::uint32_t key;  // see sortKey
  std::uint32_t voxel;
};

// A number that grows with the distance; voxels of a later group come after all of an earlier one. Groups 0
// and 1. The last bit of the distance's mantissa is lost.
std::uint32_t sortKey(float distance, int group = 0);

// By key; equal ones keep their order.
void sortByDistance(std::vector<FarVoxel>& voxels);

}  // namespace fluidtex::sim
