#include "sim/leaf_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <unordered_map>

namespace fluidtex::sim {

LeafTable makeLeafTable(const FloatTree& tree) {
  LeafTable table;
  const auto leaves = leavesOf(tree);
  table.origins.reserve(leaves.size());
  std::unordered_map<Coord, std::int32_t> numberOf;
  numberOf.reserve(leaves.size());
  for (const FloatLeaf* leaf : leaves) {
    numberOf.emplace(leaf->origin(), static_cast<std::int32_t>(table.origins.size()));
    table.origins.push_back(leaf->origin());
  }
  table.next.resize(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (int direction = 0; direction < 6; ++direction) {
      Coord there = table.origins[n];
      there[direction >> 1] += (direction & 1) != 0 ? kLeafDim : -kLeafDim;
      const auto found = numberOf.find(there);
      table.next[n][static_cast<std::size_t>(direction)] = found == numberOf.end() ? -1 : found->second;
    }
  });
  return table;
}

const float* leafValues(const FloatTree& tree, const Coord& origin, float* scratch) {
  const FloatLeaf* leaf = tree.probeConstLeaf(origin);
  if (leaf != nullptr) return leaf->buffer().data();
  std::fill_n(scratch, kLeafSize, tree.getValue(origin));
  return scratch;
}

std::vector<float> sampleOn(const LeafTable& table, const FloatTree& tree) {
  std::vector<float> values(table.voxels());
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    float* to = values.data() + n * kLeafSize;
    const float* from = leafValues(tree, table.origins[n], to);
    if (from != to) std::copy_n(from, kLeafSize, to);
  });
  return values;
}

}  // namespace fluidtex::sim
