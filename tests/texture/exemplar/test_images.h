// Small images for tests.
#pragma once

#include "numerics/random.h"
#include "texture/exemplar/exemplar.h"

#include <cmath>
#include <functional>

namespace fluidtex::testing {

inline texture::Image imageOf(int width, int height, int channels,
                              const std::function<float(int, int, int)>& value) {
  texture::Image image{width, height, channels, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) image.data.push_back(value(x, y, c));
  return image;
}

// Independent values in 0..1.
inline texture::Image noiseImage(int width, int height, int channels, std::uint64_t seed) {
  return imageOf(width, height, channels, [&](int x, int y, int c) {
    return float(randomUnit(seed, std::uint64_t((y * width + x) * channels + c)));
  });
}

// Smooth blobs of about `size` pixels, different in every channel; the last of four is opaque.
inline texture::Image blobImage(int width, int height, int channels, double size, std::uint64_t seed) {
  return imageOf(width, height, channels, [&](int x, int y, int c) {
    if (c == 3) return 1.0f;
    double sum = 0.0;
    for (int k = 0; k < 6; ++k) {
      const auto random = [&](int i) { return randomUnit(seed, std::uint64_t((c * 6 + k) * 4 + i)); };
      const double angle = 6.2832 * random(0);
      const double frequency = 6.2832 / size * (0.6 + 0.8 * random(1));
      sum += std::sin(frequency * (x * std::cos(angle) + y * std::sin(angle)) + 6.2832 * random(2));
    }
    return float(0.5 + 0.5 * std::tanh(0.8 * sum));
  });
}

}  // namespace fluidtex::testing
