#include "sim/volume/deficit_grid.h"

#include "sim/grid/require.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::sim {
namespace {

// Largest share of a cell that is given back at once.
constexpr float kMost = 0.5f;

}  // namespace

double totalDeficit(const FloatGrid& deficit) {
  double cells = 0.0;
  for (auto leaf = deficit.constTree().cbeginLeaf(); leaf; ++leaf)
    cells += std::accumulate(leaf->buffer().data(), leaf->buffer().data() + kLeafSize, 0.0);
  return cells * std::pow(deficit.voxelSize()[0], 3);
}

ShownLiquid shownAround(const MaskGrid& where, const FloatGrid& phi, const SolidField& solid) {
  MaskGrid::TreeType blocks;
  for (auto leaf = where.constTree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    for (int n = 0; n < 27; ++n)
      blocks.touchLeaf(leaf->origin().offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1),
                                               kLeafDim * (n % 3 - 1)));
  }
  ShownLiquid shown;
  for (auto leaf = blocks.cbeginLeaf(); leaf; ++leaf) shown.blocks.push_back(leaf->origin());
  shown.shares.resize(shown.blocks.size());
  tbb::parallel_for(std::size_t{0}, shown.blocks.size(),
                    [&](std::size_t n) { liquidShares(phi, solid, shown.blocks[n], shown.shares[n]); });
  return shown;
}

void addChange(FloatGrid& deficit, const ShownLiquid& before, const FloatGrid& phi, const SolidField& solid) {
  std::vector<FloatLeaf*> leaves(before.blocks.size());
  for (std::size_t n = 0; n < leaves.size(); ++n) leaves[n] = deficit.tree().touchLeaf(before.blocks[n]);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafShares after;
    liquidShares(phi, solid, before.blocks[n], after);
    leaves[n]->setValuesOn();
    for (int i = 0; i < kLeafSize; ++i)
      leaves[n]->setValueOnly(i, leaves[n]->getValue(i) + before.shares[n][i] - after[i]);
  });
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const float* values = leaves[n]->buffer().data();
    if (std::all_of(values, values + kLeafSize, [](float v) { return v == 0.0f; }))
      delete deficit.tree().stealNode<FloatLeaf>(before.blocks[n], 0.0f, false);
  }
}

Vec3d placeOfLargest(const FloatGrid& deficit) {
  double most = -1.0;
  Coord cell(0);
  for (auto leaf = deficit.constTree().cbeginLeaf(); leaf; ++leaf) {
    const float* values = leaf->buffer().data();
    const double sum = std::abs(std::accumulate(values, values + kLeafSize, 0.0));
    if (sum <= most) continue;
    most = sum;
    const float* largest = std::max_element(values, values + kLeafSize,
                                            [](float a, float b) { return std::abs(a) < std::abs(b); });
    cell = leaf->offsetToGlobalCoord(static_cast<openvdb::Index>(largest - values));
  }
  return deficit.indexToWorld(cell);
}

FloatGrid::Ptr targetDivergence(const FloatGrid& deficit, double time) {
  require(time > 0.0, "targetDivergence: the time must be positive");
  FloatGrid::Ptr divergence = deficit.deepCopy();
  const float rate = static_cast<float>(1.0 / time);
  const auto leaves = leavesOf(divergence->tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) values[i] = rate * std::clamp(values[i], -kMost, kMost);
  });
  return divergence;
}

}  // namespace fluidtex::sim
