// Section C.5 of the reference: a film of viscous liquid flows down an incline, in at one end and out at the
// other. The edge that it falls off raises it upstream, so the channel is 16 depths long and figures are
// those of its middle half.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

std::vector<Case> filmCases();

}  // namespace fluidtex::validation
