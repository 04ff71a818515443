// The solver's grids: OpenVDB grids with blocks of 8 x 8 x 8 values, but with small nodes above the blocks.
// OpenVDB's FloatGrid takes 2.4 MB before it holds a value, since a tree with indices on both sides of 0
// needs eight nodes of 262 kB. A solver with forty grids has no use for nodes of 4096 cells.
#pragma once

#include "sim/grid/compile_once.h"

#include <openvdb/openvdb.h>

namespace fluidtex::sim {

// Nodes of 256 and of 32 cells a side, 4 and 0.6 kB.
template <typename Value>
using TreeOf = typename openvdb::tree::Tree4<Value, 3, 2, 3>::Type;

using FloatTree = TreeOf<float>;
using FloatGrid = openvdb::Grid<FloatTree>;
using IndexTree = TreeOf<std::int32_t>;
using MaskTree = TreeOf<openvdb::ValueMask>;
using MaskGrid = openvdb::Grid<MaskTree>;

// Conversion to OpenVDB's own grid type, and back: keeps every value and active state, also those of tiles,
// and transform, name and other metadata. Tiles are as large as they can be.
openvdb::FloatGrid::Ptr toOpenVdb(const FloatGrid& grid);
FloatGrid::Ptr fromOpenVdb(const openvdb::FloatGrid& grid);

}  // namespace fluidtex::sim

FLUIDTEX_GRID(extern, fluidtex::sim::FloatTree)
FLUIDTEX_GRID(extern, fluidtex::sim::IndexTree)
FLUIDTEX_GRID(extern, fluidtex::sim::MaskTree)
