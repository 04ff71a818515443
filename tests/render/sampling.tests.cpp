#include "render/sampling.h"

#include <catch2/catch.hpp>

#include <set>

using namespace fluidtex::render;

TEST_CASE("sample points: every elementary interval of a pixel's 16 points holds one", "[render]") {
  for (int pixel = 0; pixel < 50; ++pixel) {
    const PixelSamples samples(37 * pixel % 101, 13 * pixel % 89, 16, 7);
    for (int dimension = 0; dimension < 6; ++dimension)
      for (const auto& [columns, rows] : {std::pair{16, 1}, {8, 2}, {4, 4}, {2, 8}, {1, 16}}) {
        std::set<int> cells;
        for (int s = 0; s < 16; ++s) {
          const Vec2f u = samples.point(s, dimension);
          REQUIRE(u[0] >= 0.0f);
          REQUIRE(u[0] < 1.0f);
          REQUIRE(u[1] >= 0.0f);
          REQUIRE(u[1] < 1.0f);
          cells.insert(static_cast<int>(u[0] * columns) * rows + static_cast<int>(u[1] * rows));
        }
        REQUIRE(cells.size() == 16);
      }
  }
}

TEST_CASE("sample points: the four pixels of a block complete each other", "[render]") {
  std::set<int> cells;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x)
      for (int s = 0; s < 4; ++s) {
        const Vec2f u = PixelSamples(10 + x, 20 + y, 4, 1).point(s, 2);
        cells.insert(static_cast<int>(u[0] * 4) * 4 + static_cast<int>(u[1] * 4));
      }
  REQUIRE(cells.size() == 16);
}

TEST_CASE("sample points: dimensions are not correlated", "[render]") {
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const PixelSamples samples(x, y, 8, 3);
      for (int s = 0; s < 8; ++s, ++count)
        sum += (samples.point(s, 1)[0] - 0.5) * (samples.point(s, 2)[0] - 0.5);
    }
  // Independent numbers: mean 0, standard deviation (1/12) / sqrt(count) = 0.0009.
  REQUIRE(std::abs(sum / count) < 0.005);
}

TEST_CASE("sample points: frames and pixels differ, the same call repeats", "[render]") {
  const Vec2f a = PixelSamples(5, 6, 16, 1).point(3, 0);
  REQUIRE(a == PixelSamples(5, 6, 16, 1).point(3, 0));
  REQUIRE(a != PixelSamples(5, 6, 16, 2).point(3, 0));
  REQUIRE(a != PixelSamples(6, 6, 16, 1).point(3, 0));
}

TEST_CASE("sample points: pictures too large for 32 bits of index do not repeat themselves", "[render]") {
  REQUIRE(PixelSamples(5, 6, 1024, 1).point(3, 0) != PixelSamples(5 + 2048, 6, 1024, 1).point(3, 0));
}

TEST_CASE("sampling maps: moments are those of the densities", "[render]") {
  double tent = 0.0, tentSquare = 0.0, cosine = 0.0, cone = 0.0, disc = 0.0;
  constexpr int kSide = 200;
  constexpr float kCosMax = 0.6f;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec2f u((i + 0.5f) / kSide, (j + 0.5f) / kSide);
      const Vec2f offset = tentOffset(u, 0.7f);
      tent += offset[0];
      tentSquare += offset[0] * offset[0];
      const Vec3f h = cosineHemisphere(u), c = uniformCone(u, kCosMax);
      REQUIRE(h.length() == Approx(1.0f).margin(1e-5));
      REQUIRE(c.length() == Approx(1.0f).margin(1e-5));
      REQUIRE(c[2] >= kCosMax);
      cosine += h[2];
      cone += c[2];
      disc += uniformDisc(u).dot(uniformDisc(u));
    }
  constexpr double kCount = kSide * kSide;
  REQUIRE(tent / kCount == Approx(0.0).margin(1e-5));
  REQUIRE(tentSquare / kCount == Approx(0.49 / 6.0).epsilon(1e-3));
  REQUIRE(cosine / kCount == Approx(2.0 / 3.0).epsilon(1e-3));
  REQUIRE(cone / kCount == Approx(0.8).epsilon(1e-3));
  REQUIRE(disc / kCount == Approx(0.5).epsilon(1e-3));
}
