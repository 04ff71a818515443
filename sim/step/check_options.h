// Validity of the solver's settings. Those of a scene file are checked before, key by key.
#pragma once

#include "sim/options.h"

namespace fluidtex::sim {

// Returns the options unchanged. Throws std::invalid_argument, with the reason, where a length, a rate or a
// property of the liquid is not finite, not positive, or negative where 0 is allowed.
const Options& checked(const Options& options);

}  // namespace fluidtex::sim
