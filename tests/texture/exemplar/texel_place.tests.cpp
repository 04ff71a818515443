#include "texture/exemplar/texel_place.h"

#include "tests/texture/exemplar/test_images.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("texel place: corners lie on corners and centres on centres, whatever the image's size") {
  const Image fine = noiseImage(32, 24, 1, 1), coarse = noiseImage(4, 2, 1, 1);
  const TexelToImage toFine(8, 6, fine), toCoarse(8, 6, coarse), same(4, 2, coarse);
  CHECK(toFine({-0.5f, -0.5f}) == Vec2f(-0.5f, -0.5f));
  CHECK(toFine({7.5f, 5.5f}) == Vec2f(31.5f, 23.5f));
  CHECK(toFine({0.0f, 0.0f}) == Vec2f(1.5f, 1.5f));  // the middle of its four by four pixels
  CHECK(toCoarse({-0.5f, -0.5f}) == Vec2f(-0.5f, -0.5f));
  CHECK(toCoarse({7.5f, 5.5f}) == Vec2f(3.5f, 1.5f));
  CHECK(toCoarse({0.5f, 1.0f}) == Vec2f(0.0f, 0.0f));  // two columns of three rows are one
  CHECK(same({1.25f, 0.75f}) == Vec2f(1.25f, 0.75f));
  TexturedSurface surface;
  surface.exemplarWidth = 8, surface.exemplarHeight = 6;
  CHECK(TexelToImage(surface, fine)({3.0f, 2.0f}) == toFine({3.0f, 2.0f}));
}

TEST_CASE("texel place: an image without pixels and an exemplar without a size are refused") {
  CHECK_THROWS_AS(TexelToImage(8, 6, Image{}), std::invalid_argument);
  CHECK_THROWS_AS(TexelToImage(0, 6, noiseImage(4, 4, 1, 1)), std::invalid_argument);
  CHECK_THROWS_AS(TexelToImage(8, 0, noiseImage(4, 4, 1, 1)), std::invalid_argument);
  CHECK_THROWS_AS(TexelToImage(TexturedSurface{}, noiseImage(4, 4, 1, 1)), std::invalid_argument);
}

TEST_CASE("texel place: what is left of a former colour is nothing where nothing fades") {
  CHECK(leftOf(Fading{}, 5) == 0.0f);
  Fading fading = noFading(3);
  fading.weight[2] = 0.4f;
  CHECK(leftOf(fading, 1) == 0.0f);
  CHECK(leftOf(fading, 2) == 0.4f);
}
