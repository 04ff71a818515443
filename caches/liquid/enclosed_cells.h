// What a surface encloses.
#pragma once

#include "caches/liquid/triangle_raster.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/voxel_mask.h"

#include <vector>

namespace fluidtex::caches {

// Cells to which no way leads from far away, along lines between the centres of cells side by side that
// nothing crosses.
struct EnclosedCells {
  sim::VoxelMask cells;                   // of the blocks in the list
  std::vector<openvdb::CoordBBox> boxes;  // all blocks that nothing crosses, in the list or not
};

// crossed: of the first blocks. All lines of other blocks, in the list or not, are free. Time and memory
// follow the blocks that are crossed.
EnclosedCells enclosedCells(const sim::LeafTable& blocks, const std::vector<CrossedLines>& crossed);

}  // namespace fluidtex::caches
