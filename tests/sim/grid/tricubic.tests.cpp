#include "sim/grid/tricubic.h"

#include "sim/vec3.h"

#include <catch2/catch.hpp>

#include <random>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("tricubic: reproduces polynomials of third degree along each axis") {
  const auto along = [](double a, double b, double c, double d, double x) {
    return a + x * (b + x * (c + x * d));
  };
  const auto polynomial = [&](const Vec3d& x) {
    return along(1.0, -0.4, 0.3, -0.05, x[0]) * along(0.5, 0.2, -0.1, 0.04, x[1]) *
           along(-0.7, 0.6, 0.2, -0.03, x[2]);
  };
  constexpr int kSide = 5;
  std::vector<float> block;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      for (int k = 0; k < kSide; ++k) block.push_back(static_cast<float>(polynomial(Vec3d(i, j, k))));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0.0f, 1.0f);
  for (int n = 0; n < 100; ++n) {
    const Vec3d t(place(random), place(random), place(random));
    const float value = tricubic(block.data() + (1 * kSide + 1) * kSide + 1, kSide * kSide, kSide,
                                 float(t[0]), float(t[1]), float(t[2]));
    CHECK_THAT(value, WithinAbs(polynomial(Vec3d(1.0) + t), 1e-5));
  }
}
