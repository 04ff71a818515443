// Frames without synthesis, to compare with.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// An oriented surface in one pale colour, age 0 and coordinates 0; trust and previousPosition as carried, or
// 0 and the positions themselves.
TexturedSurface untextured(Surface surface, const Carried& carried);

// An oriented surface with what was carried to it, older by secondsSinceLast, and nothing more: pure
// advection. carried must not be empty.
TexturedSurface advected(Surface surface, const Carried& carried, double secondsSinceLast);

}  // namespace fluidtex::texture
