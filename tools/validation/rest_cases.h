#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Liquid at rest and in free fall, sections C.3 and C.4 of the reference.
std::vector<Case> restCases();

}  // namespace fluidtex::validation
