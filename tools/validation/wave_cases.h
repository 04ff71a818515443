#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// Taylor-Green vortices and standing waves, sections C.1 and C.8 of the reference.
std::vector<Case> waveCases();

}  // namespace fluidtex::validation
