// How much joints stand out of the texture around them in a picture.
#pragma once

#include "tools/joints/look.h"

namespace fluidtex::joints {

inline constexpr float kStep = 0.1f;  // gradients above this, of lightness a pixel, count as steps

// Of the pixels of one kind. Gradients are of lightness a pixel, from a pixel to the next at its right and
// below it; they count where all three are of the kind and each is less than `near` from the first, so that
// contours, behind which something else is seen, do not.
struct Contrast {
  double gradient = 0.0;   // mean
  double steps = 0.0;      // share above kStep
  double deviation = 0.0;  // standard deviation of lightness
  std::size_t pixels = 0, gradients = 0;
};

// near: metres, a texel.
Contrast contrastOf(const Seen& seen, std::size_t way, Kind kind, double near);

}  // namespace fluidtex::joints
