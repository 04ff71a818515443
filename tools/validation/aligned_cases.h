#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Pools at rest beside solids that lie on halves and quarters of cells, as people place them: there walls
// pass through centres and corners of cells exactly, which places drawn by chance never do.
std::vector<Case> alignedCases();

}  // namespace fluidtex::validation
