// Sorting of voxels by distance.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// A voxel of a LeafTable with its distance from the start of a sweep.
struct FarVoxel {
  std::uint32_t key;  // see sortKey
  std::uint32_t voxel;
};

// An integer that increases with the distance; voxels of group 1 come after all of group 0. The last bit of
// the distance's mantissa is lost.
std::uint32_t sortKey(float distance, int group = 0);

// Sorts by key; the order of equal keys is kept.
void sortByDistance(std::vector<FarVoxel>& voxels);

}  // namespace fluidtex::sim
