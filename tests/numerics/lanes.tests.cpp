#include "numerics/lanes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;

TEST_CASE("lanes: stored as loaded, summed, and halves keep eleven bits") {
  const float from[8] = {1.0f, -2.0f, 3.5f, 0.0f, 0.25f, 7.0f, -0.125f, 100.0f};
  float to[8] = {};
  store8(to, load8(from));
  double sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    CHECK(to[k] == from[k]);
    sum += from[k];
  }
  CHECK(sum8(load8(from)) == float(sum));
  for (int n = 0; n <= 1000; ++n) {
    const float x = float(n) / 1000.0f;
    const Float8 back = widened(narrowed(Float8{x, -x}));
    CHECK(std::abs(back[0] - x) <= x * 0x1p-11f);
    CHECK(back[1] == -back[0]);
  }
}

TEST_CASE("lanes: fours are loaded, filled, joined and taken apart again") {
  const float from[4] = {1.0f, -2.0f, 3.5f, 0.25f};
  float to[4] = {};
  store4(to, load4(from));
  const Float4 same = float4(7.0f), place = float4(4.0f, 5.0f, 6.0f);
  CHECK(place[3] == 0.0f);
  const Float8 both = joined8(load4(from), same), filled = float8(-3.0f);
  for (int k = 0; k < 4; ++k) {
    CHECK(to[k] == from[k]);
    CHECK(same[k] == 7.0f);
    CHECK(low4(both)[k] == from[k]);
    CHECK(high4(both)[k] == 7.0f);
    CHECK((both[k] == from[k] && both[k + 4] == 7.0f));
    CHECK((filled[k] == -3.0f && filled[k + 4] == -3.0f));
  }
}

TEST_CASE("lanes: bits tell which lanes are below and which are selected") {
  const Float8 v{0.0f, 1.0f, 2.0f, 3.0f, 2.0f, -5.0f, NAN, 2.5f};
  CHECK(atMost8(v, 2.0f) == 0b00110111u);
  CHECK(below8(v, 2.0f) == 0b00100011u);
  const Float8 ones = Float8{} + 1.0f, picked = select8(0b10000101u, ones, Float8{});
  for (int k = 0; k < 8; ++k) CHECK(picked[k] == (k == 0 || k == 2 || k == 7 ? 1.0f : 0.0f));
  Short16 shorts{};
  for (int k = 0; k < 16; ++k) shorts[k] = std::int16_t(k * k - 50);
  unsigned expected = 0;
  for (int k = 0; k < 16; ++k) expected |= unsigned(k * k - 50 <= 14) << k;
  CHECK(atMost16(shorts, 14) == expected);
}
