// The pressure by a manufactured solution: cut cells at a curved solid, and a curved free surface.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> pressureCases();

}  // namespace fluidtex::validation
