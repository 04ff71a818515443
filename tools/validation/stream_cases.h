// Section C.11 of the reference: liquid that comes in and goes out.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> streamCases();

}  // namespace fluidtex::validation
