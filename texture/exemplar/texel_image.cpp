#include "texture/exemplar/texel_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fluidtex::texture {
namespace {

constexpr float kMostHalf = 65504.0f;  // largest half

float wrapped(float x, float size) {
  x -= size * std::floor(x / size);
  return x < size ? x : 0.0f;  // a tiny negative number rounds up to size
}

// Written so that NaN becomes the lower bound.
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
  tbb::parallel_for(-margin, image.height + margin, [&](int y) {
    for (int x = -margin; x < image.width + margin; ++x) {
      const float* from = image.at(source(x, image.width), source(y, image.height));
      Float8 texel{};
      for (int c = 0; c < image.channels; ++c) texel[c] = std::clamp(from[c], -kMostHalf, kMostHalf);
      result.data[std::size_t(y + margin) * result.stride + std::size_t(x + margin)] = narrowed(texel);
    }
  });
  return result;
}

float randomDifference(const TexelImage& image, const Float8& channelWeight) {
  struct Sums {
    std::array<double, kMaxChannels> values{}, squares{};
  };
  std::vector<Sums> rows(
      std::size_t(image.height));  // then added in order: the same on any number of threads
  tbb::parallel_for(0, image.height, [&](int y) {
    const std::size_t row =
        std::size_t(y + image.margin) * std::size_t(image.stride) + std::size_t(image.margin);
    for (int x = 0; x < image.width; ++x) {
      const Float8 texel = image.at(row + std::size_t(x));
      for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const double value = texel[c];
        rows[std::size_t(y)].values[c] += value;
        rows[std::size_t(y)].squares[c] += value * value;
      }
    }
  });
  double variance = 0.0;
  const double count = double(image.width) * image.height;
  for (std::size_t c = 0; c < std::size_t(image.channels); ++c) {
    double sum = 0.0, squares = 0.0;
    for (const Sums& row : rows) sum += row.values[c], squares += row.squares[c];
    variance += channelWeight[c] * std::max(0.0, squares / count - (sum / count) * (sum / count));
  }
  return float(std::sqrt(2.0 * variance));
}

}  // namespace fluidtex::texture
