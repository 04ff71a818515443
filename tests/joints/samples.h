// Pictures for tests of what joints look like.
#pragma once

#include "numerics/random.h"
#include "texture/exemplar/srgb.h"
#include "texture/shown/color_between.h"

namespace fluidtex::testing {

// Grey, opaque, 64 x 48 pixels, toroidal; its lightness is random.
inline texture::Detail noise() {
  texture::Image image{64, 48, 4, {}};
  for (int i = 0; i < 64 * 48; ++i) {
    const float grey = texture::decodeSrgb(float(randomUnit(5, std::uint64_t(i))));
    image.data.insert(image.data.end(), {grey, grey, grey, 1.0f});
  }
  return texture::makeDetail(std::move(image), true, 64);
}

inline float lightnessOf(const texture::Vec4f& color) {
  return texture::encodeSrgb(texture::luminance(color.asPointer()) * color[3]);
}

}  // namespace fluidtex::testing
