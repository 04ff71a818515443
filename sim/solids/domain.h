// Extent of the domain.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/options.h"

namespace fluidtex::sim {

// The cells of the domain: from 0 to cellCount() - 1, extended to kEndless from 0 where a side is unbounded.
CoordBBox domainCells(const Options& options);

// The domain in metres: [0, size], infinite where a side is unbounded.
openvdb::BBoxd domainBox(const Options& options);

}  // namespace fluidtex::sim
