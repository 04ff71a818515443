// Gaps that moving solids close.
#pragma once

#include "sim/options.h"

namespace fluidtex::stress {

// Width of the narrowest gap that a solid with keyframes closes at a time, metres: from its surface, where
// that moves forward, along the normal to another solid or a wall of the domain. Infinite where none is
// closed. Looked for once in a cell.
double closingGap(const sim::Options& options, double time);

}  // namespace fluidtex::stress
