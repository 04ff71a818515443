#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Collapsing columns, sections C.6 and C.7 of the reference, and the volume of a closed dam break.
std::vector<Case> damBreakCases();

}  // namespace fluidtex::validation
