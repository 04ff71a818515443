// The pressure by a manufactured solution: cut cells at a curved solid, and a curved free surface.
#pragma once

#include "tests/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> pressureCases();

}  // namespace fluidtex::validation
