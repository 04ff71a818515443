// The liquid's part of a frame, whatever moved it.
#pragma once

#include "sim/frame/frame.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Fills in surfacePhi, solidPhi, and the cells and volume of the statistics.
void describeLiquid(Frame& frame, const FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
