// Sections C.10 and C.11 of the reference that the theory of shallow water answers.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> shallowCases();

}  // namespace fluidtex::validation
