// Pictures as floats, and how they are sampled between texels.
#pragma once

#include "texture/surface.h"

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace fluidtex::texture {

struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> data;  // height x width x channels, rows from the top
  float* at(int x, int y) { return data.data() + (std::size_t(y) * width + x) * channels; }
  const float* at(int x, int y) const { return data.data() + (std::size_t(y) * width + x) * channels; }
};

// Bilinear, texel centres at integers; outside it is clamped, or wrapped where `toroidal`. Writes
// image.channels values.
void sampleBilinear(const Image& image, bool toroidal, const Vec2f& texel, float* out);

// The same by Catmull and Rom's cubics over 4 x 4 texels, held between the values of the four nearest:
// half-way between texels bilinear interpolation loses half of the finest detail, this a fifth, and it does
// not ring.
void sampleCubic(const Image& image, bool toroidal, const Vec2f& texel, float* out);

// The same of RGBA with straight alpha, premultiplied before it is interpolated, so that it does not matter
// what colour a transparent texel has; straight() takes alpha out again, and leaves black where there is
// none.
Vec4f samplePremultiplied(const Image& color, bool toroidal, const Vec2f& texel);
inline Vec4f straight(const Vec4f& premultiplied) {
  const float alpha = premultiplied[3];
  if (!(alpha > 1e-6f)) return Vec4f(0.0f);
  return {premultiplied[0] / alpha, premultiplied[1] / alpha, premultiplied[2] / alpha, alpha};
}

// The input is wrong; the message is one sentence that names the file.
struct ExemplarError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace fluidtex::texture
