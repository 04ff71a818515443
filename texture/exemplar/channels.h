// Two channels that are matched beside the colours, so that windows agree in their features and not only in
// their means: signed distance from features [Lefebvre06] and gradient energy.
#pragma once

#include "texture/exemplar/exemplar.h"

namespace fluidtex::texture {

// Gaussian blur of standard deviation sigma (pixels), every channel; edges are continued by their pixels, or
// wrapped.
Image blur(const Image& image, bool toroidal, double sigma);

// What the channels are made from, one channel: the sRGB-encoded luminance of premultiplied colours (Rec. 709
// weights); where alpha is not one everywhere, half luminance and half alpha. encoded: premultiplied encoded
// RGB, and A where it varies.
Image featureLuminance(const Image& encoded);

// Signed distance from the features of L, scaled to 0..1: 0 is 4 px inside a feature or deeper, 1 is 8 px
// outside or farther. Features are what d = blur(L, 1) - blur(L, 10) exceeds by 0.8 of its standard
// deviation, on the side (bright or dark) to which d is skewed, and at least 40 px large. No feature at all:
// 1 everywhere.
Image featureDistance(const Image& luminance, bool toroidal);

// sqrt(blur(|grad L|^2, 1 px)) over its 99% quantile, capped at 1.2. A plain image: 0 everywhere.
Image gradientEnergy(const Image& luminance, bool toroidal);

// Half the size (rounded up): the mean of 2x2 pixels, the last column or row of an odd image with itself, or
// with the first where it is toroidal.
Image halve(const Image& image, bool toroidal);

}  // namespace fluidtex::texture
