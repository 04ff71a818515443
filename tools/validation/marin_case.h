// Section C.7 of the reference: water runs against a box (SPHERIC test 2).
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> marinCases();

}  // namespace fluidtex::validation
