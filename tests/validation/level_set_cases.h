#pragma once

#include "tests/validation/case.h"

namespace fluidtex::validation {

// Advection of shapes by known flows, sections A.1 to A.3 and A.5 of the reference.
std::vector<Case> levelSetCases();

}  // namespace fluidtex::validation
