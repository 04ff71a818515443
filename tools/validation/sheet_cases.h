// Sheets of liquid a few cells thick, of which the surface should be as smooth as the flow: one that falls,
// one that slides down an incline without friction, and one that has come to rest.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> sheetCases();

}  // namespace fluidtex::validation
