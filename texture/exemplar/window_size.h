// How wide a window of an image can be.
#pragma once

#include "texture/exemplar/image.h"

namespace fluidtex::texture {

// The width used at an image: `window`, or where the image is too small for it the largest odd width that
// leaves a choice of windows: 5/8 of the shorter side, the whole shorter side where the image is toroidal.
int fittingWindow(const Image& match, bool toroidal, int window);

// Narrower windows are not matched: an exemplar is taken only if it has room for one of these.
inline constexpr int kSmallestWindow = 3;

}  // namespace fluidtex::texture
