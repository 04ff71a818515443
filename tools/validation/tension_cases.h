#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Surface tension: a drop at rest, drops that swing, a ripple.
std::vector<Case> tensionCases();

}  // namespace fluidtex::validation
