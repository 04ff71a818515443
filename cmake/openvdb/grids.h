// OpenVDB's own grids, as files hold them, are compiled in this folder alone. Precompiled for all that links
// OpenVDB, see cmake/precompile.cmake.
#pragma once

#include "sim/grid/compile_once.h"

FLUIDTEX_GRID(extern, openvdb::FloatTree)
FLUIDTEX_GRID(extern, openvdb::Int32Tree)
FLUIDTEX_GRID(extern, openvdb::Vec3STree)
FLUIDTEX_GRID(extern, openvdb::MaskTree)
