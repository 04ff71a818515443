#include "sim/grid/grids.h"

FLUIDTEX_GRID(, fluidtex::sim::MaskTree)
