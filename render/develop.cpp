#include "render/develop.h"

#include "texture/exemplar/srgb.h"

#include <cmath>

namespace fluidtex::render {

float developed(float radiance, double exposure) {
  constexpr float kKnee = 0.8f, kAbove = 1.0f - kKnee;
  const float x = radiance * static_cast<float>(exposure);
  if (!(x > kKnee)) return std::isfinite(x) ? x : 0.0f;
  return kKnee + kAbove * (1.0f - std::exp(-(x - kKnee) / kAbove));
}

float displayed(float radiance, double exposure) {
  return texture::encodeSrgb(developed(radiance, exposure));
}

}  // namespace fluidtex::render
