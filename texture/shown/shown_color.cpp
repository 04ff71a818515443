#include "texture/shown/shown_color.h"

#include "texture/exemplar/channels.h"
#include "texture/exemplar/srgb.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::texture {
namespace {

// Squared differences of lightness below this count as none.
constexpr float kSame = 1e-3f;

// Lightness of a premultiplied colour.
float lightness(const float* rgb) {
  return encodeSrgb(luminance(rgb));
}

}  // namespace

Image lightnessAround(const Image& color, bool toroidal, int halvings) {
  Image result{color.width, color.height, 1, std::vector<float>(color.data.size() / 4)};
  forEachIndex(result.data.size(), [&](std::uint32_t i) {
    const float* rgba = color.data.data() + 4 * std::size_t(i);
    result.data[i] = lightness((Vec3f(rgba) * rgba[3]).asPointer());
  });
  for (int i = 0; i < halvings; ++i) result = halve(result, toroidal);
  return result;
}

Reading readAt(const Image& color, const Image& around, bool toroidal, const Vec2f& texel, int halvings) {
  const auto size = float(1 << halvings), shift = 0.5f * (size - 1.0f);
  Reading result{samplePremultiplied(color, toroidal, texel)};
  sampleBilinear(around, toroidal, (texel - Vec2f(shift, shift)) * (1.0f / size), &result.mean);
  return result;
}

Vec4f faded(const Reading& now, const Reading& former, float weight) {
  const float angle = 0.5f * std::numbers::pi_v<float> * weight, a = std::cos(angle), b = std::sin(angle);
  const float one = lightness(now.color.asPointer()), other = lightness(former.color.asPointer());
  const float wanted = std::clamp(
      now.mean + weight * (former.mean - now.mean) + a * (one - now.mean) + b * (other - former.mean),
      std::min(one, other), std::max(one, other));
  // The colour of that lightness on the line between both; by the weight where they are equally bright.
  const float from = decodeSrgb(other), way = decodeSrgb(one) - from;
  const float along = way != 0.0f ? (decodeSrgb(wanted) - from) / way : 0.0f;
  const float differ = (one - other) * (one - other);
  const float share = (along * differ + kSame * (1.0f - weight)) / (differ + kSame);
  return straight(former.color + (now.color - former.color) * share);
}

Vec4f shownColor(const Image& color, const Image& around, bool toroidal, const Vec2f& present,
                 const Vec2f& former, float weight, int halvings) {
  if (weight == 0.0f) return straight(samplePremultiplied(color, toroidal, present));
  return faded(readAt(color, around, toroidal, present, halvings),
               readAt(color, around, toroidal, former, halvings), weight);
}

}  // namespace fluidtex::texture
