#include "texture/transition/smooth_noise.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;

TEST_CASE(
    "smooth noise: every value is as frequent as any other, neighbours are alike, a seed is a picture") {
  const int width = 80, height = 60;
  const std::vector<float> noise = smoothNoise(width, height, 6.0, 7);
  std::vector<float> sorted = noise;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t n = 0; n < sorted.size(); ++n)
    REQUIRE(sorted[n] == Approx((double(n) + 0.5) / (width * height)).epsilon(1e-5));
  double step = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 1; x < width; ++x) step += std::abs(noise[y * width + x] - noise[y * width + x - 1]);
  // Of independent values it would be 1/3.
  CHECK(step / (height * (width - 1)) < 0.08);
  CHECK(noise == smoothNoise(width, height, 6.0, 7));
  CHECK(noise != smoothNoise(width, height, 6.0, 8));
}
