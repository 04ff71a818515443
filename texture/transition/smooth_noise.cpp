#include "texture/transition/smooth_noise.h"

#include "numerics/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

// Blurs rows of `length` values that lie `step` apart, mirrored at both ends.
void blurLine(float* line, int length, std::size_t step, const std::vector<float>& weights) {
  const int reach = int(weights.size()) - 1;
  std::vector<float> old(std::size_t(length), 0.0f);
  for (int i = 0; i < length; ++i) old[std::size_t(i)] = line[std::size_t(i) * step];
  const auto at = [&](int i) {
    const int period = 2 * length;
    const int within = ((i % period) + period) % period;
    return old[std::size_t(within < length ? within : period - 1 - within)];
  };
  for (int i = 0; i < length; ++i) {
    float sum = weights[0] * at(i);
    for (int k = 1; k <= reach; ++k) sum += weights[std::size_t(k)] * (at(i - k) + at(i + k));
    line[std::size_t(i) * step] = sum;
  }
}

}  // namespace

std::vector<float> smoothNoise(int width, int height, double sigma, std::uint64_t seed) {
  const std::size_t count = std::size_t(width) * std::size_t(height);
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = float(randomUnit(seed, i));
  std::vector<float> weights;
  for (int k = 0; k <= int(std::ceil(3.0 * sigma)); ++k)
    weights.push_back(float(std::exp(-0.5 * k * k / (sigma * sigma))));
  for (int y = 0; y < height; ++y)
    blurLine(values.data() + std::size_t(y) * std::size_t(width), width, 1, weights);
  for (int x = 0; x < width; ++x) blurLine(values.data() + x, height, std::size_t(width), weights);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  std::vector<float> ranks(count);
  for (std::size_t n = 0; n < count; ++n) ranks[order[n]] = (float(n) + 0.5f) / float(count);
  return ranks;
}

}  // namespace fluidtex::texture
