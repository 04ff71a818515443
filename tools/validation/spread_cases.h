// Section C.9 of the reference: a very viscous block spreads under its own weight.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> spreadCases();

}  // namespace fluidtex::validation
