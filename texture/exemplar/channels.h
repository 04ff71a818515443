// Two channels matched beside colour, so that windows agree in their features and not only in their means:
// signed distance from features [Lefebvre06] and gradient energy.
#pragma once

#include "texture/exemplar/exemplar.h"

namespace fluidtex::texture {

// Gaussian blur of standard deviation sigma, pixels, per channel. Edges are clamped, or wrapped where
// toroidal.
Image blur(const Image& image, bool toroidal, double sigma);

// Input of the feature channels, one channel: sRGB-encoded luminance of premultiplied colours (Rec. 709
// weights); where alpha varies, half luminance and half alpha. encoded: premultiplied encoded RGB, and A
// where it varies.
Image featureLuminance(const Image& encoded);

// Signed distance from the features of L, scaled to 0..1: 0 is 4 px or more inside a feature, 1 is 8 px or
// more outside. Features are where d = blur(L, 1) - blur(L, 10) exceeds 0.8 of its standard deviation, on the
// side (bright or dark) to which d is skewed, in parts of at least 40 px. Without features: 1 everywhere.
Image featureDistance(const Image& luminance, bool toroidal);

// sqrt(blur(|grad L|^2, 1 px)) over its 99% quantile, capped at 1.2. A plain image: 0 everywhere.
Image gradientEnergy(const Image& luminance, bool toroidal);

// Half the size, rounded up: means of 2x2 pixels. The last column or row of an odd image is averaged with
// itself, or with the first where toroidal.
Image halve(const Image& image, bool toroidal);

}  // namespace fluidtex::texture
