#include "texture/texel_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fluidtex::texture {
namespace {

float wrapped(float x, float size) {
  x -= size * std::floor(x / size);
  return x < size ? x : 0.0f;  // a tiny negative number rounds up to size
}

// Clamped so that a coordinate that is not a number becomes the lower bound.
float clamped(float x, float low, float high) {
  return x > low ? std::min(x, std::max(low, high)) : low;
}

}  // namespace

Vec2f TexelImage::broughtFromOutside(const Vec2f& texel) const {
  if (toroidal) return Vec2f(wrapped(texel[0], float(width)), wrapped(texel[1], float(height)));
  return Vec2f(clamped(texel[0], 0.0f, float(width - 1)), clamped(texel[1], 0.0f, float(height - 1)));
}

Vec2f TexelImage::centerFor(const Vec2f& texel, float reach) const {
  if (toroidal) return brought(texel);
  const float rx = std::min(reach, 0.5f * float(width - 1)), ry = std::min(reach, 0.5f * float(height - 1));
  return Vec2f(clamped(texel[0], rx, float(width - 1) - rx), clamped(texel[1], ry, float(height - 1) - ry));
}

TexelImage makeTexelImage(const Image& image, bool toroidal, int margin) {
  if (image.channels > kMaxChannels)
    throw std::invalid_argument("at most " + std::to_string(kMaxChannels) + " channels can be matched, not " +
                                std::to_string(image.channels));
  TexelImage result;
  result.width = image.width;
  result.height = image.height;
  result.channels = image.channels;
  result.margin = margin;
  result.stride = image.width + 2 * margin;
  result.toroidal = toroidal;
  result.data.resize(std::size_t(result.stride) * (image.height + 2 * margin));
  const auto source = [&](int i, int size) {
    return toroidal ? ((i % size) + size) % size : std::clamp(i, 0, size - 1);
  };
  for (int y = -margin; y < image.height + margin; ++y) {
    for (int x = -margin; x < image.width + margin; ++x) {
      const float* from = image.at(source(x, image.width), source(y, image.height));
      Float8 texel{};
      for (int c = 0; c < image.channels; ++c) texel[c] = from[c];
      result.data[std::size_t(y + margin) * result.stride + std::size_t(x + margin)] = texel;
    }
  }
  return result;
}

float randomDifference(const TexelImage& image, const Float8& channelWeight) {
  double variance = 0.0;
  for (int c = 0; c < image.channels; ++c) {
    double sum = 0.0, squares = 0.0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double value =
            image.data[std::size_t(y + image.margin) * image.stride + std::size_t(x + image.margin)][c];
        sum += value;
        squares += value * value;
      }
    }
    const double count = double(image.width) * image.height;
    variance += channelWeight[c] * std::max(0.0, squares / count - (sum / count) * (sum / count));
  }
  return float(std::sqrt(2.0 * variance));
}

}  // namespace fluidtex::texture
