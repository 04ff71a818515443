#include "sim/grid/local_reach.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

LocalReach::LocalReach(const Velocity& velocity, double dt) : m_blocks(0.0f) {
  const FloatGrid& first = *velocity.component[0];
  const float scale = static_cast<float>(dt / first.voxelSize()[0]);
  const auto leaves = leavesOf(first.constTree());
  std::vector<float> reach(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    // Eight side by side.
    float largest[kLeafDim] = {};
    for (const auto& grid : velocity.component) {
      const FloatLeaf* leaf = grid->constTree().probeConstLeaf(leaves[n]->origin());
      if (leaf == nullptr) continue;
      const float* value = leaf->buffer().data();
      for (int row = 0; row < kLeafSize; row += kLeafDim) {
        for (int k = 0; k < kLeafDim; ++k) {
          const float speed = std::abs(value[row + k]);
          largest[k] = speed > largest[k] ? speed : largest[k];
        }
      }
    }
    reach[n] = scale * *std::max_element(largest, largest + kLeafDim);
  });
  openvdb::tree::ValueAccessor<FloatTree> blocks(m_blocks);
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    blocks.setValue(leaves[n]->origin() >> 3, reach[n]);
    m_farthest = std::max(m_farthest, reach[n]);
  }
}

float LocalReach::from(const Coord& origin) const {
  const openvdb::tree::ValueAccessor<const FloatTree, false> blocks(m_blocks);
  float largest = 0.0f;
  for (int n = 0; n < 27; ++n) {
    const Coord beside = (origin >> 3).offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
    largest = std::max(largest, blocks.getValue(beside));
  }
  return largest;
}

}  // namespace fluidtex::sim
