#include "texture/labels/usage.h"

#include "tests/texture/exemplar/test_images.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("usage: 1 everywhere where all is used evenly, twice as much where it is used twice") {
  const TexelImage image = makeTexelImage(noiseImage(40, 24, 3, 1), true, 4);
  Usage usage(image, 8, 40 * 24);
  CHECK(usage.at({10.0f, 10.0f}) == 0.0f);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 40; ++x) usage.add({float(x), float(y)}, 1.0f);
  for (const Vec2f& texel : {Vec2f(0.0f, 0.0f), Vec2f(19.7f, 11.2f), Vec2f(39.0f, 23.0f)})
    CHECK(usage.at(texel) == Approx(1.0f).epsilon(1e-4));
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 40; ++x) usage.add({float(x), float(y)}, 1.0f);
  CHECK(usage.at({19.7f, 11.2f}) == Approx(2.0f).epsilon(1e-4));
}

TEST_CASE("usage: what is used counts where it is, and beyond the edge where the picture wraps") {
  for (const bool toroidal : {true, false}) {
    const TexelImage image = makeTexelImage(noiseImage(40, 40, 3, 1), toroidal, 4);
    Usage usage(image, 8, 25);
    usage.add({0.0f, 20.0f}, 1.0f);
    CHECK(usage.at({2.0f, 20.0f}) > 0.2f);
    CHECK(usage.at({20.0f, 20.0f}) == 0.0f);
    CHECK((usage.at({39.0f, 20.0f}) > 0.0f) == toroidal);
    usage.add({0.0f, 20.0f}, -1.0f);
    CHECK(usage.at({2.0f, 20.0f}) == Approx(0.0f).margin(1e-6));
  }
}
