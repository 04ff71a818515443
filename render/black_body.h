// The glow of what is hot.
#pragma once

#include "render/vec.h"

namespace fluidtex::render {

// Radiance of a black body, linear Rec. 709, in an arbitrary unit that is the same for all temperatures
// (Planck's law, seen by the CIE 1931 observer). Colours outside the gamut are clipped to it. Precondition:
// kelvin > 0.
Vec3f blackBody(double kelvin);

}  // namespace fluidtex::render
