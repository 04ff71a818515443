// Symmetry sides of the level set. Beyond them phi is its own mirror image, so that a surface that meets them
// is smooth there and its distance as accurate as elsewhere.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Mirrors phi beyond the symmetry sides, in the leaves that it has.
void mirrorAtSides(FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
