// The linear system of the pressure, with ghost-fluid rows at the free surface: Gibou, Fedkiw, Cheng and
// Kang, "A second-order-accurate symmetric discretization of the Poisson equation on irregular domains",
// 2002. The distance to the surface is part of the cells (`theta`, sim/pressure/liquid_cells.h), and enters
// the diagonal here. The right-hand side is formed in sim/pressure/pressure.cpp.
#pragma once

#include "sim/poisson/poisson.h"
#include "sim/pressure/liquid_cells.h"

#include <vector>

namespace fluidtex::sim {

// The system for q = p dt / (density h) in liquid cells that are not detached. detached: one entry a cell;
// such cells have pressure 0 at their centre. liquidOf: gets the liquid cell of each unknown. The right-hand
// side is -LiquidCells::outflow.
PoissonSystem pressureSystem(const LiquidCells& liquid, const std::vector<char>& detached,
                             std::vector<int>& liquidOf);

}  // namespace fluidtex::sim
