#include "sim/grid/leaf_table.h"

#include "numerics/block_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {
namespace {

// Calls add(box) for the tiles below 0 of all nodes of one level that reach into the box.
template <class Node, class Add>
void addTilesOf(const FloatTree& tree, const openvdb::CoordBBox& within, const Add& add) {
  constexpr int kTile = Node::ChildNodeType::DIM;
  std::vector<const Node*> nodes;
  tree.getNodes(nodes);
  for (const Node* node : nodes) {
    openvdb::CoordBBox box = node->getNodeBoundingBox();
    box.intersect(within);
    if (box.empty()) continue;
    for (int i = box.min().x() & ~(kTile - 1); i <= box.max().x(); i += kTile) {
      for (int j = box.min().y() & ~(kTile - 1); j <= box.max().y(); j += kTile) {
        for (int k = box.min().z() & ~(kTile - 1); k <= box.max().z(); k += kTile) {
          const openvdb::Index at = Node::coordToOffset(Coord(i, j, k));
          if (!node->isChildMaskOn(at) && node->getTable()[at].getValue() < 0.0f)
            add(openvdb::CoordBBox::createCube(Coord(i, j, k), kTile));
        }
      }
    }
  }
}

}  // namespace

LeafTable makeLeafTable(const FloatTree& tree) {
  LeafTable table;
  const auto leaves = leavesOf(tree);
  table.origins.reserve(leaves.size());
  BlockTable numbers(leaves.size());
  for (const FloatLeaf* leaf : leaves) {
    numbers.enter(leaf->origin());
    table.origins.push_back(leaf->origin());
  }
  table.next.resize(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (int direction = 0; direction < 6; ++direction) {
      Coord there = table.origins[n];
      there[direction >> 1] += (direction & 1) != 0 ? kLeafDim : -kLeafDim;
      const std::uint32_t number = numbers.find(there);
      table.next[n][static_cast<std::size_t>(direction)] =
          number == BlockTable::kNone ? -1 : static_cast<std::int32_t>(number);
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

std::vector<Coord> wetLeaves(const FloatGrid& phi, const CoordBBox& within) {
  std::vector<Coord> origins;
  const Coord low = leafOrigin(within.min()), &high = within.max();
  const auto inBox = [&](const Coord& origin) {
    return Coord::lessThan(origin, low) ? false : !Coord::lessThan(high, origin);
  };
  for (const FloatLeaf* leaf : leavesOf(phi.constTree()))
    if (inBox(leaf->origin())) origins.push_back(leaf->origin());
  // Tiles of liquid, split into blocks; those of a level set are inactive.
  const auto addTile = [&](openvdb::CoordBBox box) {
    box.intersect({low, high});
    if (box.empty()) return;
    for (int i = box.min().x() & ~(kLeafDim - 1); i <= box.max().x(); i += kLeafDim)
      for (int j = box.min().y() & ~(kLeafDim - 1); j <= box.max().y(); j += kLeafDim)
        for (int k = box.min().z() & ~(kLeafDim - 1); k <= box.max().z(); k += kLeafDim)
          origins.emplace_back(i, j, k);
  };
  auto tile = phi.constTree().cbeginValueAll();
  tile.setMaxDepth(0);
  for (; tile; ++tile) {
    if (*tile < 0.0f) addTile(tile.getBoundingBox());
  }
  // Nodes have thousands of tiles: only those in the box are visited.
  using Upper = FloatTree::RootNodeType::ChildNodeType;
  using Lower = Upper::ChildNodeType;
  addTilesOf<Upper>(phi.constTree(), {low, high}, addTile);
  addTilesOf<Lower>(phi.constTree(), {low, high}, addTile);
  std::sort(origins.begin(), origins.end());
  return origins;
}

}  // namespace fluidtex::sim
