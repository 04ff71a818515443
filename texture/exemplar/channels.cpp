// Signed distance from features: after S. Lefebvre, H. Hoppe, "Appearance-space texture synthesis", 2006.
// These channels and their constants did best in a comparison on planar textures.

#include "texture/exemplar/channels.h"

#include "texture/exemplar/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fluidtex::texture {
namespace {

constexpr double kNarrowBlur = 1.0, kWideBlur = 10.0;  // px: features are thinner than the wide one
constexpr double kFeatureThreshold = 0.8;              // standard deviations of the difference of the blurs
constexpr int kSmallestFeature = 40;                   // px
constexpr float kInside = 4.0f, kOutside = 8.0f;       // px: clamping of the signed distance
constexpr int kReach = 10;                             // px: distances are exact up to here
constexpr double kGradientCap = 1.2;
constexpr double kQuantile = 0.99;
// Contrast below half a step of an 8-bit image is quantisation, not texture.
constexpr double kNoise = 0.5 / 255.0;

// Index i of n, wrapped or clamped.
int continued(int i, int n, bool toroidal) {
  if (!toroidal) return std::clamp(i, 0, n - 1);
  i %= n;
  return i < 0 ? i + n : i;
}

std::vector<float> gaussian(double sigma) {
  const int radius = std::max(1, int(std::ceil(3.0 * sigma)));
  std::vector<float> kernel(std::size_t(2 * radius + 1));
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  for (int i = -radius; i <= radius; ++i)
    kernel[std::size_t(i + radius)] = float(std::exp(-0.5 * i * i / (sigma * sigma)) / sum);
  return kernel;
}

// Removes 8-connected parts of the mask with fewer than `smallest` pixels.
void dropSmallParts(std::vector<std::uint8_t>& mask, int width, int height, bool toroidal, int smallest) {
  std::vector<std::uint8_t> seen(mask.size(), 0);
  std::vector<std::size_t> part;
  for (std::size_t start = 0; start < mask.size(); ++start) {
    if (!mask[start] || seen[start]) continue;
    part.assign(1, start);
    seen[start] = 1;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int x = int(part[next] % std::size_t(width)), y = int(part[next] / std::size_t(width));
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t other = std::size_t(continued(y + dy, height, toroidal)) * std::size_t(width) +
                                    std::size_t(continued(x + dx, width, toroidal));
          if (!mask[other] || seen[other]) continue;
          seen[other] = 1;
          part.push_back(other);
        }
    }
    if (int(part.size()) < smallest)
      for (const std::size_t pixel : part) mask[pixel] = 0;
  }
}

// Distance from each pixel's centre to the nearest centre where mask == value, exact up to kReach: along rows
// first, then the least sum of squares along columns.
std::vector<float> distanceTo(const std::vector<std::uint8_t>& mask, std::uint8_t value, int width,
                              int height, bool toroidal) {
  std::vector<int> along(mask.size());  // squared
  std::vector<float> distance(mask.size());
  const auto rowOf = [&](int y) { return std::size_t(continued(y, height, toroidal)) * std::size_t(width); };
  tbb::parallel_for(0, height, [&](int y) {
    const std::uint8_t* row = mask.data() + rowOf(y);
    int* nearest = along.data() + rowOf(y);
    const auto step = [&](int x, int since) {
      return row[continued(x, width, toroidal)] == value ? 0 : std::min(since + 1, kReach);
    };
    int since = kReach;  // distance from the last such pixel, left to right, then right to left
    for (int x = -kReach; x < 0; ++x) since = step(x, since);
    for (int x = 0; x < width; ++x) nearest[x] = since = step(x, since);
    since = kReach;
    for (int x = width + kReach - 1; x >= width; --x) since = step(x, since);
    for (int x = width - 1; x >= 0; --x) nearest[x] = std::min(nearest[x], since = step(x, since));
    for (int x = 0; x < width; ++x) nearest[x] *= nearest[x];
  });
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<int> squared(std::size_t(width), kReach * kReach);
    for (int d = -kReach; d <= kReach; ++d) {
      const int* row = along.data() + rowOf(y + d);
      for (int x = 0; x < width; ++x)
        squared[std::size_t(x)] = std::min(squared[std::size_t(x)], d * d + row[x]);
    }
    for (int x = 0; x < width; ++x)
      distance[rowOf(y) + std::size_t(x)] = std::sqrt(float(squared[std::size_t(x)]));
  });
  return distance;
}

Image likeSize(const Image& image, int channels) {
  Image result{image.width, image.height, channels, {}};
  result.data.resize(std::size_t(image.width) * std::size_t(image.height) * std::size_t(channels));
  return result;
}

}  // namespace

Image blur(const Image& image, bool toroidal, double sigma) {
  const std::vector<float> kernel = gaussian(sigma);
  const int taps = int(kernel.size()), radius = taps / 2, channels = image.channels;
  const std::size_t rowSize = std::size_t(image.width) * std::size_t(channels);
  Image rows = likeSize(image, channels), result = likeSize(image, channels);
  tbb::parallel_for(0, image.height, [&](int y) {
    std::vector<float> row;
    row.reserve(rowSize + std::size_t(2 * radius * channels));
    for (int x = -radius; x < image.width + radius; ++x) {
      const float* pixel = image.at(continued(x, image.width, toroidal), y);
      row.insert(row.end(), pixel, pixel + channels);
    }
    float* out = rows.at(0, y);
    for (int i = 0; i < taps; ++i)
      for (std::size_t x = 0; x < rowSize; ++x)
        out[x] += kernel[std::size_t(i)] * row[x + std::size_t(i * channels)];
  });
  tbb::parallel_for(0, image.height, [&](int y) {
    float* out = result.at(0, y);
    for (int i = 0; i < taps; ++i) {
      const float* in = rows.at(0, continued(y + i - radius, image.height, toroidal));
      for (std::size_t x = 0; x < rowSize; ++x) out[x] += kernel[std::size_t(i)] * in[x];
    }
  });
  return result;
}

Image featureLuminance(const Image& encoded) {
  Image result = likeSize(encoded, 1);
  for (std::size_t i = 0; i < result.data.size(); ++i) {
    const float* p = encoded.data.data() + i * std::size_t(encoded.channels);
    result.data[i] = encoded.channels > 3 ? 0.5f * (luminance(p) + p[3]) : luminance(p);
  }
  return result;
}

Image featureDistance(const Image& luminance, bool toroidal) {
  Image difference = blur(luminance, toroidal, kNarrowBlur);
  const Image wide = blur(luminance, toroidal, kWideBlur);
  double mean = 0.0, squares = 0.0, cubes = 0.0;
  for (std::size_t i = 0; i < difference.data.size(); ++i) {
    difference.data[i] -= wide.data[i];
    const double d = difference.data[i];
    mean += d, squares += d * d, cubes += d * d * d;
  }
  const double count = double(difference.data.size());
  mean /= count;
  const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
  const float sign = cubes < 0.0 ? -1.0f : 1.0f;

  std::vector<std::uint8_t> mask(difference.data.size(), 0);
  if (deviation > kNoise)
    for (std::size_t i = 0; i < mask.size(); ++i)
      mask[i] = sign * difference.data[i] > kFeatureThreshold * deviation;
  dropSmallParts(mask, luminance.width, luminance.height, toroidal, kSmallestFeature);

  const std::vector<float> toInside = distanceTo(mask, 1, luminance.width, luminance.height, toroidal);
  const std::vector<float> toOutside = distanceTo(mask, 0, luminance.width, luminance.height, toroidal);
  Image result = likeSize(luminance, 1);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    // The outline runs half way between an inner and an outer pixel.
    const float distance = mask[i] ? 0.5f - toOutside[i] : toInside[i] - 0.5f;
    result.data[i] = (std::clamp(distance, -kInside, kOutside) + kInside) / (kInside + kOutside);
  }
  return result;
}

Image gradientEnergy(const Image& luminance, bool toroidal) {
  Image squared = likeSize(luminance, 1);
  tbb::parallel_for(0, luminance.height, [&](int y) {
    for (int x = 0; x < luminance.width; ++x) {
      // Central differences; one-sided at a clamped edge.
      const int left = toroidal ? x - 1 : std::max(x - 1, 0),
                right = toroidal ? x + 1 : std::min(x + 1, luminance.width - 1);
      const int above = toroidal ? y - 1 : std::max(y - 1, 0),
                below = toroidal ? y + 1 : std::min(y + 1, luminance.height - 1);
      const auto value = [&](int i, int j) {
        return *luminance.at(continued(i, luminance.width, true), continued(j, luminance.height, true));
      };
      const float dx = (value(right, y) - value(left, y)) / float(std::max(1, right - left));
      const float dy = (value(x, below) - value(x, above)) / float(std::max(1, below - above));
      *squared.at(x, y) = dx * dx + dy * dy;
    }
  });
  Image result = blur(squared, toroidal, 1.0);
  for (float& value : result.data) value = std::sqrt(value);
  std::vector<float> sorted = result.data;
  const auto quantile = sorted.begin() + std::ptrdiff_t(kQuantile * double(sorted.size() - 1));
  std::nth_element(sorted.begin(), quantile, sorted.end());
  const float scale = 1.0f / float(std::max(double(*quantile), kNoise));
  for (float& value : result.data) value = std::min(value * scale, float(kGradientCap));
  return result;
}

Image halve(const Image& image, bool toroidal) {
  Image result{(image.width + 1) / 2, (image.height + 1) / 2, image.channels, {}};
  result.data.resize(std::size_t(result.width) * std::size_t(result.height) * std::size_t(image.channels));
  tbb::parallel_for(0, result.height, [&](int y) {
    const int below = continued(2 * y + 1, image.height, toroidal);
    for (int x = 0; x < result.width; ++x) {
      const int right = continued(2 * x + 1, image.width, toroidal);
      const float *a = image.at(2 * x, 2 * y), *b = image.at(right, 2 * y), *c = image.at(2 * x, below),
                  *d = image.at(right, below);
      for (int k = 0; k < image.channels; ++k) result.at(x, y)[k] = 0.25f * ((a[k] + b[k]) + (c[k] + d[k]));
    }
  });
  return result;
}

}  // namespace fluidtex::texture
