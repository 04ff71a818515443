#include "texture/shown_color.h"

#include "texture/channels.h"
#include "texture/srgb.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::texture {
namespace {

constexpr int kHalvings = 3;
// Differences of luminance, squared, below which two places count as equally bright.
constexpr float kSame = 1e-3f;

// What is shown at a place, and the mean around it; premultiplied.
struct Reading {
  Vec4f color, mean;
};

Reading readAt(const Image& colors, const Image& around, bool toroidal, const Vec2f& texel) {
  constexpr float kScale = 1.0f / float(1 << kHalvings), kShift = 0.5f * float((1 << kHalvings) - 1);
  Reading result{samplePremultiplied(colors, toroidal, texel), Vec4f(0.0f)};
  sampleBilinear(around, toroidal, (texel - Vec2f(kShift, kShift)) * kScale, result.mean.asPointer());
  return result;
}

}  // namespace

Image meansAround(const Image& color, bool toroidal) {
  Image result = color;
  for (std::size_t i = 0; i < result.data.size(); i += 4)
    for (std::size_t k = 0; k < 3; ++k) result.data[i + k] *= result.data[i + 3];
  for (int i = 0; i < kHalvings; ++i) result = halve(result, toroidal);
  return result;
}

Vec4f shownColor(const Image& colors, const Image& around, bool toroidal, const Vec2f& present,
                 const Vec2f& former, float weight) {
  if (weight == 0.0f) return straight(samplePremultiplied(colors, toroidal, present));
  const Reading now = readAt(colors, around, toroidal, present),
                old = readAt(colors, around, toroidal, former);
  const float angle = 0.5f * std::numbers::pi_v<float> * weight, a = std::cos(angle), b = std::sin(angle);
  const float mean = luminance(now.mean.asPointer()) +
                     weight * (luminance(old.mean.asPointer()) - luminance(now.mean.asPointer()));
  const float one = luminance(now.color.asPointer()), other = luminance(old.color.asPointer());
  const float wanted = std::clamp(
      mean + a * (one - luminance(now.mean.asPointer())) + b * (other - luminance(old.mean.asPointer())),
      std::min(one, other), std::max(one, other));
  // The colour on the way from one to the other that is as bright; where both are, the way's own share.
  const float way = one - other;
  const float share = ((wanted - other) * way + kSame * (1.0f - weight)) / (way * way + kSame);
  return straight(old.color + (now.color - old.color) * share);
}

}  // namespace fluidtex::texture
