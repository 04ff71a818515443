#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using Catch::Matchers::WithinAbs;

TEST_CASE("srgb: the curve's published values, and back", "[texture]") {
  CHECK(encodeSrgb(0.0f) == 0.0f);
  CHECK_THAT(encodeSrgb(1.0f), WithinAbs(1.0, 1e-6));
  CHECK_THAT(encodeSrgb(0.5f), WithinAbs(0.7353569, 1e-6));
  CHECK_THAT(decodeSrgb(0.5f), WithinAbs(0.2140411, 1e-6));
  for (float value = -0.5f; value < 2.0f; value += 0.013f)
    CHECK_THAT(decodeSrgb(encodeSrgb(value)), WithinAbs(value, 1e-5));
}
