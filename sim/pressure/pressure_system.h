// The linear system of the pressure.
#pragma once

#include "sim/poisson/poisson.h"
#include "sim/pressure/liquid_cells.h"

#include <vector>

namespace fluidtex::sim {

// The system for q = p dt / (density h) in the liquid's cells that are not detached (one entry a cell; those
// have pressure 0 at their centre). `liquidOf` gets each unknown's number as a liquid cell. The right-hand
// side is LiquidCells::outflow with the sign changed.
PoissonSystem pressureSystem(const LiquidCells& liquid, const std::vector<char>& detached,
                             std::vector<int>& liquidOf);

}  // namespace fluidtex::sim
