#include "texture/exemplar/image.h"

#include "tests/texture/exemplar/test_images.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::randomUnit;

TEST_CASE("bilinear: exact for a linear image, at texel centres and between", "[texture]") {
  Image image{7, 5, 2, {}};
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x)
      image.data.insert(image.data.end(), {float(x) - 2.0f * float(y), 1.0f + 0.5f * float(x)});
  for (float y = 0.0f; y <= 4.0f; y += 0.125f)
    for (float x = 0.0f; x <= 6.0f; x += 0.125f) {
      float out[2];
      sampleBilinear(image, false, {x, y}, out);
      CHECK(out[0] == x - 2.0f * y);
      CHECK(out[1] == 1.0f + 0.5f * x);
    }
}

TEST_CASE("bilinear: outside it is clamped or wrapped", "[texture]") {
  const Image image{3, 2, 1, {0, 1, 2, 10, 11, 12}};
  const auto at = [&](bool toroidal, float x, float y) {
    float out;
    sampleBilinear(image, toroidal, {x, y}, &out);
    return out;
  };
  CHECK(at(false, -5.0f, -1.0f) == 0.0f);
  CHECK(at(false, 9.0f, 0.5f) == 7.0f);
  CHECK(at(false, 1e30f, 1e30f) == 12.0f);
  CHECK(at(true, 2.5f, 0.0f) == 1.0f);  // half way from the last column to the first
  CHECK(at(true, -0.5f, 0.0f) == 1.0f);
  CHECK(at(true, 0.0f, 1.5f) == 5.0f);
  for (float x = 0.0f; x < 3.0f; x += 0.25f)
    for (float y = 0.0f; y < 2.0f; y += 0.25f) {
      CHECK(at(true, x - 6.0f, y + 8.0f) == at(true, x, y));
      CHECK(at(true, x + 3.0f, y - 2.0f) == at(true, x, y));
    }
  // A coordinate that is no number reads some texel.
  CHECK(std::isfinite(at(false, std::numeric_limits<float>::quiet_NaN(), 0.0f)));
  CHECK(std::isfinite(at(true, 0.0f, std::numeric_limits<float>::quiet_NaN())));
  CHECK(std::isfinite(at(true, -1e30f, std::numeric_limits<float>::infinity())));
}

TEST_CASE("cubic: passes through texels, exact for a linear image, never beyond the four around") {
  Image ramp{9, 9, 1, {}}, random{9, 9, 1, {}};
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) {
      ramp.data.push_back(float(x) - 2.0f * float(y));
      random.data.push_back(float(randomUnit(3, std::uint64_t(9 * y + x))));
    }
  float out;
  for (float y = 1.0f; y <= 7.0f; y += 0.25f)
    for (float x = 1.0f; x <= 7.0f; x += 0.25f) {
      sampleCubic(ramp, false, {x, y}, &out);
      CHECK(out == Approx(x - 2.0f * y).margin(1e-5));
      sampleCubic(random, false, {x, y}, &out);
      const int i = std::min(int(x), 7), j = std::min(int(y), 7);
      const auto [least, most] = std::minmax(
          {*random.at(i, j), *random.at(i + 1, j), *random.at(i, j + 1), *random.at(i + 1, j + 1)});
      CHECK((out >= least && out <= most));
      if (x == std::floor(x) && y == std::floor(y)) CHECK(out == Approx(*random.at(int(x), int(y))));
    }
  sampleCubic(random, true, {8.5f, 3.0f}, &out);
  const float wrapped = out;
  sampleCubic(random, true, {-0.5f, 3.0f}, &out);
  CHECK(wrapped == Approx(out));
  sampleCubic(random, false, {1e30f, -1e30f}, &out);
  CHECK(out == *random.at(8, 0));
  sampleCubic(random, false, {NAN, NAN}, &out);
  CHECK(std::isfinite(out));
}

TEST_CASE("premultiplied: what cannot be seen has no colour") {
  Image color = noiseImage(9, 7, 4, 5), multiplied = color, hidden = color;
  for (std::size_t i = 0; i < color.data.size(); i += 4) {
    if (i % 12 == 0) {
      color.data[i + 3] = multiplied.data[i + 3] = hidden.data[i + 3] = 0.0f;
      hidden.data[i] = 7e3f;
    }
    for (std::size_t c = 0; c < 3; ++c) multiplied.data[i + c] *= multiplied.data[i + 3];
  }
  const bool toroidal = GENERATE(false, true);
  for (float y = -1.0f; y < 8.0f; y += 0.37f)
    for (float x = -1.0f; x < 10.0f; x += 0.41f) {
      const Vec4f found = samplePremultiplied(color, toroidal, {x, y});
      Vec4f expected;
      sampleCubic(multiplied, toroidal, {x, y}, expected.asPointer());
      CHECK(found == expected);
      CHECK(samplePremultiplied(hidden, toroidal, {x, y}) == found);
    }
}

TEST_CASE("straight: divides by alpha, and is black where there is none") {
  const Vec4f seen = straight({0.25f, 0.125f, 0.5f, 0.5f});
  CHECK(seen == Vec4f(0.5f, 0.25f, 1.0f, 0.5f));
  CHECK(straight({0.3f, 0.2f, 0.1f, 1.0f}) == Vec4f(0.3f, 0.2f, 0.1f, 1.0f));
  CHECK(straight({0.3f, 0.2f, 0.1f, 0.0f}) == Vec4f(0.0f));
  CHECK(straight({0.3f, 0.2f, 0.1f, -0.1f}) == Vec4f(0.0f));
  CHECK(straight({0.3f, 0.2f, 0.1f, std::numeric_limits<float>::quiet_NaN()}) == Vec4f(0.0f));
}
