#include "cmake/openvdb/grids.h"

FLUIDTEX_GRID(, openvdb::Vec3STree)
