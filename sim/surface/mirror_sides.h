// Sides of symmetry for the level set: phi goes on beyond them as its own mirror image, so that a surface
// that meets them is smooth there and its distance as good as elsewhere.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// In the leaves that phi has.
void mirrorAtSides(FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
