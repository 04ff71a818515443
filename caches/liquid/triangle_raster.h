// What one triangle says of the cells of one block of 8^3 beside it.
#pragma once

#include "sim/grid/voxel_mask.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>

namespace fluidtex::caches {

// Corners in cells from the centre of the block's first cell.
using BlockTriangle = std::array<openvdb::Vec3d, 3>;

// The closest triangle so far of each cell, by offset (sim/grid/mac_grid.h).
struct BlockNearest {
  std::array<float, sim::kLeafSize> square;  // of the distance, cells
  std::array<std::uint32_t, sim::kLeafSize> triangle;
};

// How far from triangles their distances are rastered, cells.
inline constexpr double kRasterReach = 2.0;

// Puts the triangle where it is closer than what is there: in all cells within the reach, and in some that
// are farther away. Exact, but for floats and for triangles that are a hundred thousand times as long as
// high, which count by their edges.
void rasterDistances(const BlockTriangle& corners, std::uint32_t number, BlockNearest& nearest);

// By axis: the cells from whose centre the line to that of the next cell, up the axis, is crossed.
using CrossedLines = std::array<sim::LeafBits, 3>;

// Marks the lines that the triangle crosses or touches: also those that it misses by a millionth of a cell,
// so that nothing slips through between triangles that share an edge or a corner, however they lie to the
// lines.
void rasterCrossings(const BlockTriangle& corners, CrossedLines& crossed);

}  // namespace fluidtex::caches
