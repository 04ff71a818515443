// The linear system of the pressure. At the free surface it has ghost-fluid rows (Gibou, Fedkiw, Cheng and
// Kang, "A second-order-accurate symmetric discretization of the Poisson equation on irregular domains",
// 2002): the distance to the surface comes with the cells (sim/pressure/liquid_cells.h, `theta`), and stands
// on the diagonal here; the right-hand side is in sim/pressure/pressure.cpp.
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
