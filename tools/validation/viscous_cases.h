// Sections C.1, C.2, C.5 and C.9 of the reference: flows that friction rules.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// The viscosity kernel alone, where the pressure has no part.
std::vector<Case> shearCases();

// The whole solver.
std::vector<Case> viscousFlowCases();

}  // namespace fluidtex::validation
