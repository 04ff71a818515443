#include "texture/measure/spectrum.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fluidtex::texture;

namespace {

constexpr int kSize = 33;

Stack waves(double cycles, double amplitude) {
  Stack stack(2, kSize, kSize, 3);
  for (int n = 0; n < 2; ++n)
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double along = n == 0 ? x : 0.6 * x + 0.8 * y;
        *stack.at(n, y, x) =
            float(0.5 + amplitude * std::cos(2.0 * std::numbers::pi * cycles * along / kSize));
      }
  return stack;
}

Stack noise(std::uint64_t seed) {
  Dice dice(seed);
  Stack stack(40, kSize, kSize, 1);
  for (float& value : stack.data) value = float(dice.normal());
  return stack;
}

}  // namespace

TEST_CASE("spectrum: waves have their power at their frequency, whichever way they run") {
  const std::vector<double> spectrum = radialSpectrum(waves(6.0, 0.2));
  REQUIRE(spectrum.size() == std::size_t(kSize / 2));
  const auto peak = std::max_element(spectrum.begin(), spectrum.end());
  CHECK(peak - spectrum.begin() == 5);
  CHECK(spectrum[11] < 1e-3 * *peak);
}

TEST_CASE("spectrum: that of noise is even, and distances are in decibels") {
  const std::vector<double> white = radialSpectrum(noise(1));
  for (std::size_t k = 2; k < white.size(); ++k) CHECK(white[k] == Approx(white[8]).epsilon(0.35));
  CHECK(spectrumDistance(white, white) == 0.0);
  CHECK(spectrumDistance(white, radialSpectrum(noise(2))) < 0.8);
  std::vector<double> louder = white;
  for (double& power : louder) power *= 10.0;
  CHECK(spectrumDistance(white, louder) == Approx(10.0));
  CHECK(spectrumDistance(louder, white) == Approx(10.0));
}

TEST_CASE("spectrum: without any contrast nothing differs, what is a millionth does not count") {
  const std::vector<double> flat = radialSpectrum(waves(3.0, 0.0));
  CHECK(spectrumDistance(flat, flat) == 0.0);
  CHECK(spectrumDistance({1.0, 1e-9}, {1.0, 1e-12}) == 0.0);
  CHECK(spectrumDistance({1.0, 1e-9}, {1.0, 1e-3}) == Approx(std::sqrt(0.5) * 30.0));
}
