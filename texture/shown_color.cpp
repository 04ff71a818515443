#include "texture/shown_color.h"

#include "texture/channels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::texture {
namespace {

constexpr int kHalvings = 3;

Vec4f premultiplied(const Vec4f& c) {
  return {c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]};
}

// What is shown at a place, and the mean around it; premultiplied.
struct Reading {
  Vec4f color, mean;
};

Reading readAt(const Exemplar& exemplar, const Image& around, const Vec2f& texel) {
  constexpr float kScale = 1.0f / float(1 << kHalvings), kShift = 0.5f * float((1 << kHalvings) - 1);
  Vec4f color;
  sampleCubic(exemplar.color, exemplar.toroidal, texel, color.asPointer());
  Reading result{premultiplied(color), Vec4f(0.0f)};
  sampleBilinear(around, exemplar.toroidal, (texel - Vec2f(kShift, kShift)) * kScale,
                 result.mean.asPointer());
  return result;
}

}  // namespace

Image meansAround(const Exemplar& exemplar) {
  Image result = exemplar.color;
  for (std::size_t i = 0; i < result.data.size(); i += 4)
    for (std::size_t k = 0; k < 3; ++k) result.data[i + k] *= result.data[i + 3];
  for (int i = 0; i < kHalvings; ++i) result = halve(result, exemplar.toroidal);
  return result;
}

Vec4f shownColor(const Exemplar& exemplar, const Image& around, const Vec2f& present, const Vec2f& former,
                 float weight) {
  if (weight == 0.0f) {
    Vec4f color;
    sampleCubic(exemplar.color, exemplar.toroidal, present, color.asPointer());
    return color;
  }
  const Reading now = readAt(exemplar, around, present), old = readAt(exemplar, around, former);
  const float angle = 0.5f * std::numbers::pi_v<float> * weight, a = std::cos(angle), b = std::sin(angle);
  Vec4f mixed;
  for (int k = 0; k < 4; ++k) {
    const float mean = now.mean[k] + weight * (old.mean[k] - now.mean[k]);
    const float value = mean + a * (now.color[k] - now.mean[k]) + b * (old.color[k] - old.mean[k]);
    const float one = now.color[k], other = old.color[k];
    mixed[k] = std::clamp(value, std::min(one, other), std::max(one, other));
  }
  const float alpha = mixed[3];
  if (!(alpha > 1e-6f)) return {now.color[0], now.color[1], now.color[2], 0.0f};
  return {mixed[0] / alpha, mixed[1] / alpha, mixed[2] / alpha, alpha};
}

}  // namespace fluidtex::texture
