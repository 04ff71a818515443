// Float images and their sampling.
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

// Bilinear; texel centres at integers; clamped outside, or wrapped where `toroidal`. Writes image.channels
// values.
void sampleBilinear(const Image& image, bool toroidal, const Vec2f& texel, float* out);

// Catmull-Rom cubic over 4 x 4 texels, clamped to the range of the nearest four. Half-way between texels
// bilinear interpolation loses half of the finest detail, this a fifth, and it does not ring.
void sampleCubic(const Image& image, bool toroidal, const Vec2f& texel, float* out);

// sampleCubic() of straight RGBA, premultiplied before interpolation, so that the colour of transparent
// texels does not matter. straight() divides by alpha; black where alpha is 0.
Vec4f samplePremultiplied(const Image& color, bool toroidal, const Vec2f& texel);
inline Vec4f straight(const Vec4f& premultiplied) {
  const float alpha = premultiplied[3];
  if (!(alpha > 1e-6f)) return Vec4f(0.0f);
  return {premultiplied[0] / alpha, premultiplied[1] / alpha, premultiplied[2] / alpha, alpha};
}

// Invalid input; the message is one sentence that names the file.
struct ExemplarError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace fluidtex::texture
