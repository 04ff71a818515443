// Whether the solver can work with its settings at all; a scene file's are checked before, key by key.
#pragma once

#include "sim/options.h"

namespace fluidtex::sim {

// The options as they are. Throws std::invalid_argument with what is wrong where a length, a rate or a
// property of the liquid is not positive, not finite or, for those that can be 0, negative.
const Options& checked(const Options& options);

}  // namespace fluidtex::sim
