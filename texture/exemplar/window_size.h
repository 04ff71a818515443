// Width of windows that fit an image.
#pragma once

#include "texture/exemplar/image.h"

namespace fluidtex::texture {

// Window width for an image: `window`, or if the image is too small for it, the largest odd width that leaves
// a choice of windows: 5/8 of the shorter side, or the whole shorter side where toroidal.
int fittingWindow(const Image& match, bool toroidal, int window);

// Least window width; an exemplar must have room for one.
inline constexpr int kSmallestWindow = 3;

}  // namespace fluidtex::texture
