// Values of a grid, continued beyond where they are known.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/Morphology.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fluidtex::caches {

// Layers that values which end at the surface are continued by.
inline constexpr int kContinuedLayers = 3;

// `layers` more layers of active voxels around those there are, each with the mean of its active neighbours
// of the layers before (across faces): for values that end at the surface. Grid: of floats, or of vectors.
template <class Grid>
void continueOutwards(Grid& grid, int layers) {
  using Tree = typename Grid::TreeType;
  using Value = typename Grid::ValueType;
  Tree& tree = grid.tree();
  tree.voxelizeActiveTiles();
  for (int layer = 0; layer < layers; ++layer) {
    const openvdb::MaskTree before(tree, false, true, openvdb::TopologyCopy());
    openvdb::tools::dilateActiveValues(tree, 1, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
    std::vector<typename Tree::LeafNodeType*> leaves;
    tree.getNodes(leaves);
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const openvdb::tree::ValueAccessor<const openvdb::MaskTree> was(before);
      const typename Grid::ConstAccessor values(tree);
      for (auto voxel = leaves[n]->beginValueOn(); voxel; ++voxel) {
        const openvdb::Coord at = voxel.getCoord();
        if (was.isValueOn(at)) continue;
        Value sum = openvdb::zeroVal<Value>();
        int count = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {-1, 1}) {
            openvdb::Coord next = at;
            next[axis] += side;
            if (!was.isValueOn(next)) continue;
            sum += values.getValue(next);
            ++count;
          }
        voxel.setValue(sum / float(std::max(count, 1)));
      }
    });
  }
}

}  // namespace fluidtex::caches
