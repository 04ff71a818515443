#include "cmake/openvdb/grids.h"

FLUIDTEX_GRID(, openvdb::Int32Tree)
