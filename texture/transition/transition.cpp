// Based on: Kwatra, Schoedl, Essa, Turk and Bobick, "Graphcut textures", 2003: seam cost over the gradients
// (4.2).
#include "texture/transition/transition.h"

#include "numerics/random.h"
#include "texture/exemplar/srgb.h"
#include "texture/labels/min_cut.h"
#include "texture/transition/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

constexpr float kTolerance = 0.05f;   // deviation from the wanted share that costs nothing
constexpr float kAdherence = 100.0f;  // cost of a wrong piece of one feature, in lengths of seam around it
constexpr float kEdge = 6.0f;         // how much cheaper a seam is along a strong edge
constexpr float kForbidden = 1e30f;
constexpr std::uint64_t kSamples = 4096;
constexpr int kSteps[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

// The columns of a picture that lie in the transition, as they are compared: encoded premultiplied colour and
// alpha, and its gradient's length.
struct Strip {
  std::vector<Vec4f> value;
  std::vector<float> gradient;
};

Strip stripOf(const Image& image, int first, int width) {
  Strip strip;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* pixel = image.at(first + x, y);
      Vec4f value(0.0f, 0.0f, 0.0f, pixel[3]);
      for (int c = 0; c < 3; ++c) value[c] = encodeSrgb(pixel[c]) * pixel[3];
      strip.value.push_back(value);
    }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto value = [&](int i, int j) {
        return strip.value[std::size_t(std::clamp(j, 0, image.height - 1)) * std::size_t(width) +
                           std::size_t(std::clamp(i, 0, width - 1))];
      };
      const Vec4f across = value(x + 1, y) - value(x - 1, y), down = value(x, y + 1) - value(x, y - 1);
      strip.gradient.push_back(0.5f * std::sqrt(across.dot(across) + down.dot(down)));
    }
  return strip;
}

// Units of difference and of gradient, so that contrast does not matter.
struct Contrast {
  float difference, gradient;
};

Contrast contrastOf(const Strip& left, const Strip& right, std::uint64_t seed) {
  double difference = 0.0;
  std::vector<float> gradients;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const std::size_t a = randomBelow(seed, 2 * i, left.value.size());
    const std::size_t b = randomBelow(seed, 2 * i + 1, right.value.size());
    gradients.insert(gradients.end(), {left.gradient[a], right.gradient[b]});
    difference += (left.value[a] - right.value[b]).length() / double(kSamples);
  }
  const auto strong = gradients.begin() + std::ptrdiff_t(gradients.size() * 9 / 10);
  std::nth_element(gradients.begin(), strong, gradients.end());
  return {std::max(float(difference), 1e-4f), std::max(*strong, 1e-4f)};
}

void check(const Image& left, const Image& right, const TransitionOptions& options) {
  if (left.channels != 4 || right.channels != 4 || left.height != right.height || left.height < 1)
    throw std::invalid_argument("transition: the pictures must be RGBA, of one height");
  if (options.width < 8 || options.width > std::min(left.width, right.width))
    throw std::invalid_argument("transition: its width must be 8 or more, and at most that of each picture");
  if (options.feature < 2) throw std::invalid_argument("transition: a feature must have 2 pixels or more");
}

}  // namespace

std::vector<std::uint8_t> transition(const Image& left, const Image& right,
                                     const TransitionOptions& options) {
  check(left, right, options);
  const int width = options.width, height = left.height;
  const auto index = [&](int x, int y) { return std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x); };
  const Strip a = stripOf(left, left.width - width, width), b = stripOf(right, 0, width);
  const Contrast contrast = contrastOf(a, b, options.seed + 1);
  // Of the seam between two neighbours, [Kwatra03 (2)].
  const auto seamCost = [&](std::uint32_t p, std::uint32_t q) {
    const float difference = (a.value[p] - b.value[p]).length() + (a.value[q] - b.value[q]).length();
    const float edge = a.gradient[p] + a.gradient[q] + b.gradient[p] + b.gradient[q];
    return difference / contrast.difference / (1.0f + kEdge * edge / (4.0f * contrast.gradient));
  };
  const std::vector<float> threshold = smoothNoise(width, height, 0.5 * options.feature, options.seed);
  MinCut cut;
  cut.reset(threshold.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t p = index(x, y);
      const float over = (float(x) + 0.5f) / float(width) - threshold[p];
      const auto wrong = [&](float by) {
        return kAdherence / float(options.feature) * std::max(0.0f, by - kTolerance);
      };
      cut.addOwn(p, x == width - 1 ? kForbidden : wrong(over), x == 0 ? kForbidden : wrong(-over));
      for (const auto& step : kSteps) {
        const int i = x + step[0], j = y + step[1];
        if (i >= width || j < 0 || j >= height) continue;
        const float cost = (i != x && j != y ? 0.70710678f : 1.0f) * seamCost(p, index(i, j));
        cut.addPair(p, index(i, j), cost, cost);
      }
    }
  cut.solve();
  std::vector<std::uint8_t> fromRight(threshold.size());
  for (std::uint32_t p = 0; p < fromRight.size(); ++p) fromRight[p] = cut.takes(p);
  return fromRight;
}

}  // namespace fluidtex::texture
