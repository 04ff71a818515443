// The surface of liquid that has just been placed, before it has moved.
#pragma once

#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Turns phi into a distance after pouring or a change of solids, and extrapolates it behind the solids at
// which the liquid ends.
// known: cells in solids that hold phi already (sim/surface/poured_surface.h).
void settleSurface(FloatGrid& phi, const SolidField& solid, const MaskGrid& known = {});

}  // namespace fluidtex::sim
