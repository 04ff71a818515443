// sRGB transfer curve, 0..1 to 0..1 (IEC 61966-2-1), continued above 1 by its formula and below 0 as an odd
// function.
#pragma once

#include <cmath>

namespace fluidtex::texture {

inline float encodeSrgb(float linear) {
  if (linear < 0.0f) return -encodeSrgb(-linear);
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

inline float decodeSrgb(float encoded) {
  if (encoded < 0.0f) return -decodeSrgb(-encoded);
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// Luminance of linear RGB; luma of encoded RGB.
inline float luminance(const float* rgb) {
  return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

}  // namespace fluidtex::texture
