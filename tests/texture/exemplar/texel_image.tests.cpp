#include "texture/exemplar/texel_image.h"

#include "tests/texture/exemplar/test_images.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

TEST_CASE("texel image: reads what sampleBilinear reads") {
  const Image image = noiseImage(23, 17, 5, 1);
  const bool toroidal = GENERATE(false, true);
  const TexelImage texels = makeTexelImage(image, toroidal, 6);
  for (std::uint64_t i = 0; i < 500; ++i) {
    // Well beyond the edges too.
    const Vec2f at(float(randomUnit(2, 2 * i)) * 60.0f - 20.0f,
                   float(randomUnit(2, 2 * i + 1)) * 60.0f - 20.0f);
    float expected[5];
    sampleBilinear(image, toroidal, at, expected);
    const Float8 found = texels.sample(at);
    for (int c = 0; c < 5; ++c) CHECK(found[c] == Approx(expected[c]).margin(3e-4));  // half precision
    for (int c = 5; c < 8; ++c) CHECK(found[c] == 0.0f);
  }
}

TEST_CASE("texel image: the margin continues the image") {
  const TexelImage wrapping = makeTexelImage(noiseImage(12, 10, 2, 1), true, 5);
  const TexelImage ending = makeTexelImage(noiseImage(12, 10, 2, 1), false, 5);
  for (float d = -3.7f; d < 3.0f; d += 0.3f) {
    CHECK(wrapping.sampleInside(d, 4.0f)[0] == Approx(wrapping.sample({d + 12.0f, 4.0f})[0]).margin(1e-5));
    CHECK(ending.sampleInside(std::min(d, 0.0f), 4.0f)[1] == Approx(ending.sample({0.0f, 4.0f})[1]));
  }
}

TEST_CASE("texel image: coordinates that are not numbers read some texel") {
  for (const bool toroidal : {false, true}) {
    const TexelImage texels = makeTexelImage(noiseImage(12, 10, 2, 1), toroidal, 5);
    for (const float bad : {float(NAN), float(INFINITY), -float(INFINITY), 1e30f}) {
      const Vec2f at = texels.brought({bad, bad});
      CHECK((at[0] >= 0.0f && at[0] < 12.0f));
      CHECK((at[1] >= 0.0f && at[1] < 10.0f));
    }
  }
}

TEST_CASE("texel image: window centres keep their windows inside") {
  const TexelImage ending = makeTexelImage(noiseImage(30, 20, 2, 1), false, 5);
  CHECK(ending.centerFor({-5, 100}, 4) == Vec2f(4, 15));
  CHECK(ending.centerFor({10.5f, 9.25f}, 4) == Vec2f(10.5f, 9.25f));
  CHECK(ending.centerFor({0, 0}, 100) == Vec2f(14.5f, 9.5f));
  const TexelImage wrapping = makeTexelImage(noiseImage(30, 20, 2, 1), true, 5);
  CHECK(wrapping.centerFor({-5, 25}, 4) == Vec2f(25, 5));
}

TEST_CASE("texel image: too many channels are refused") {
  CHECK_THROWS_AS(makeTexelImage(noiseImage(8, 8, 9, 1), false, 2), std::invalid_argument);
}
