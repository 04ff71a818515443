#include "numerics/catmull_rom.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;

namespace {

// What samples of f at x - 1, x, x + 1 and x + 2 give at x + t.
template <class F, class T>
T sum(const std::array<T, 4>& weights, const F& f, T x) {
  return weights[0] * f(x - 1) + weights[1] * f(x) + weights[2] * f(x + 1) + weights[3] * f(x + 2);
}

}  // namespace

TEST_CASE("catmull-rom: exact for parabolas, with their slope", "[catmull_rom]") {
  const auto f = [](double x) { return 3.0 - 2.0 * x + 0.7 * x * x; };
  for (const double x : {-3.0, 0.0, 5.0}) {
    for (double t = 0.0; t <= 1.0; t += 0.125) {
      CHECK(sum(catmullRom(t), f, x) == Approx(f(x + t)));
      CHECK(sum(catmullRomSlope(t), f, x) == Approx(-2.0 + 1.4 * (x + t)));
    }
  }
}

TEST_CASE("catmull-rom: value and slope go on across a sample", "[catmull_rom]") {
  const auto f = [](float x) { return std::sin(2.0f * x) + std::abs(x); };
  for (const float x : {-2.0f, -1.0f, 0.0f, 1.0f}) {
    CHECK(sum(catmullRom(1.0f), f, x) == Approx(f(x + 1.0f)).margin(1e-6));
    CHECK(sum(catmullRom(0.0f), f, x) == Approx(f(x)).margin(1e-6));
    CHECK(sum(catmullRomSlope(1.0f), f, x) == Approx(sum(catmullRomSlope(0.0f), f, x + 1.0f)).margin(1e-6));
  }
}

TEST_CASE("catmull-rom: slopes are the derivatives of the weights", "[catmull_rom]") {
  constexpr double kStep = 1e-5;
  for (double t = 0.1; t < 1.0; t += 0.2) {
    for (int n = 0; n < 4; ++n) {
      const double difference = (catmullRom(t + kStep)[n] - catmullRom(t - kStep)[n]) / (2.0 * kStep);
      CHECK(catmullRomSlope(t)[n] == Approx(difference).margin(1e-8));
    }
  }
}
