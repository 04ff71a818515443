// What a frame says of its liquid, whatever moved it.
#pragma once

#include "sim/frame/frame.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Fills in surfacePhi, solidPhi, and of the statistics cells and volume.
void describeLiquid(Frame& frame, const FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
