// The surface of liquid that has been put somewhere, and not flowed there.
#pragma once

#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Makes phi a distance after pouring or a change of solids; it goes on behind the solids that it ends at.
void settleSurface(FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
