// Dilation of the solver's grids, compiled in one file: its loops take longer than most files' own code.
#pragma once

#include "sim/grid/grids.h"

#include <openvdb/tools/Morphology.h>

#define FLUIDTEX_DILATE(linkage, tree_type)                 \
  linkage template void openvdb::tools::dilateActiveValues( \
      tree_type&, int, openvdb::tools::NearestNeighbors, openvdb::tools::TilePolicy, bool);

FLUIDTEX_DILATE(extern, fluidtex::sim::FloatTree)
FLUIDTEX_DILATE(extern, fluidtex::sim::MaskTree)
