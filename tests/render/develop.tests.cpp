#include "render/develop.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::render;

TEST_CASE("develop: true below the knee, rising to 1 above it", "[render]") {
  CHECK(developed(0.3f, 1.0) == 0.3f);
  CHECK(developed(0.3f, 2.0) == Approx(0.6f));
  float before = developed(0.8f, 1.0);
  CHECK(before == Approx(0.8f));
  for (float x = 0.9f; x < 3.0f; x += 0.1f) {
    const float now = developed(x, 1.0);
    CHECK(now > before);
    CHECK(now < 1.0f);
    before = now;
  }
  CHECK(developed(std::numeric_limits<float>::infinity(), 1.0) <= 1.0f);
  CHECK(developed(std::numeric_limits<float>::quiet_NaN(), 1.0) == 0.0f);
}

TEST_CASE("develop: what is displayed is sRGB-encoded", "[render]") {
  CHECK(displayed(0.2140f, 1.0) == Approx(0.5f).margin(1e-3));
  CHECK(displayed(0.0f, 1.0) == 0.0f);
}
