#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Advection of shapes by known flows, sections A.1 to A.3 and A.5 of the reference. Particle level set with
// 16 markers a cell on both sides, semi-Lagrangian with a third-order back-trace and cubic interpolation, a
// CFL number of one, redistancing after every step, single precision; what moves the shapes is
// sim::moveSurface, which the solver calls too.
std::vector<Case> levelSetCases();

}  // namespace fluidtex::validation
