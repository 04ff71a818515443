#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Reinitialisation, section A.4 of the reference.
std::vector<Case> reinitCases();

}  // namespace fluidtex::validation
