// Frames without synthesis, for comparison.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// An oriented surface in one pale colour, with age 0 and coordinates 0; trust and previousPosition as
// transported, or 0 and the positions.
TexturedSurface untextured(Surface surface, const Carried& carried);

// An oriented surface with the transported texture, aged by secondsSinceLast: pure advection. Precondition:
// `carried` is not empty.
TexturedSurface advected(Surface surface, const Carried& carried, double secondsSinceLast);

}  // namespace fluidtex::texture
