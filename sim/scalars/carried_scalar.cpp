#include "sim/scalars/carried_scalar.h"

#include "sim/grid/leaf_table.h"
#include "sim/solids/table_sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {

FloatGrid::Ptr makeScalar(double h, double background) {
  FloatGrid::Ptr grid = FloatGrid::create(static_cast<float>(background));
  grid->setTransform(cellTransform(h));
  return grid;
}

FloatGrid::Ptr makeScalar(const FloatGrid& from, const FloatTree& like) {
  FloatGrid::Ptr grid = makeScalar(from.voxelSize()[0], from.background());
  for (auto leaf = like.cbeginLeaf(); leaf; ++leaf) grid->tree().touchLeaf(leaf->origin());
  const auto leaves = leavesOf(grid->tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    leaves[n]->setValuesOn();
    const FloatLeaf* before = from.constTree().probeConstLeaf(leaves[n]->origin());
    if (before != nullptr) std::copy_n(before->buffer().data(), kLeafSize, leaves[n]->buffer().data());
  });
  return grid;
}

void setInBody(FloatGrid& scalar, const std::function<double(const Vec3d&)>& distance, double value) {
  const double h = scalar.voxelSize()[0];
  const auto leaves = leavesOf(scalar.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (auto it = leaves[n]->beginValueOn(); it; ++it) {
      if (distance(scalar.indexToWorld(it.getCoord())) < 0.5 * h) it.setValue(static_cast<float>(value));
    }
  });
}

void extendScalar(FloatGrid& scalar, const FloatGrid& phi, const FloatGrid& solidPhi, int layers,
                  const Visibility* visibility) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  const LeafTable table = makeLeafTable(scalar.constTree());
  const TableSight sight(table, visibility);
  std::vector<float> value = sampleOn(table, scalar.constTree());
  const std::vector<float> p = sampleOn(table, phi.constTree()), s = sampleOn(table, solidPhi.constTree());
  std::vector<std::uint8_t> known(table.voxels());
  for (std::size_t v = 0; v < table.voxels(); ++v) known[v] = isLiquidCell(p[v], s[v], h);
  for (int layer = 0; layer < layers; ++layer) {
    std::vector<std::uint8_t> next = known;
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      for (std::size_t v = n * kLeafSize; v < (n + 1) * kLeafSize; ++v) {
        if (known[v] != 0) continue;
        float sum = 0.0f;
        int count = 0;
        for (int side = 0; side < 6; ++side) {
          const std::int64_t beside = sight.cell(static_cast<std::int64_t>(v), side);
          if (beside < 0 || known[beside] == 0) continue;
          sum += value[beside];
          ++count;
        }
        if (count == 0) continue;
        value[v] = sum / static_cast<float>(count);
        next[v] = 1;
      }
    });
    known.swap(next);
  }
  const auto leaves = leavesOf(scalar.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    std::copy_n(value.data() + n * kLeafSize, kLeafSize, leaves[n]->buffer().data());
  });
}

}  // namespace fluidtex::sim
