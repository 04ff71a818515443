// Section C.5 of the reference: a film of viscous liquid flows down an incline, in at one end and out at the
// other.
#pragma once

#include "tests/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> filmCases();

}  // namespace fluidtex::validation
