#include "texture/shown/maps.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/shown/two_vertices.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("maps: looked up at the exemplar coordinates in any resolution, with what fades") {
  const int scale = GENERATE(1, 2, 5);
  // A picture that is linear over the exemplar means the same in every resolution.
  const Image map = imageOf(8 * scale, 4 * scale, 1, [&](int x, int y, int) {
    return (float(x) + 0.5f) / float(scale) + 100.0f * (float(y) + 0.5f) / float(scale);
  });
  TexturedSurface surface = twoVertices();
  lookUpMap("height", map, false, surface);
  REQUIRE(surface.maps.at("height").size() == 2);
  CHECK(surface.maps.at("height")[0] == Approx(2.5f + 150.0f));
  CHECK(surface.maps.at("height")[1] == Approx(0.75f * (6.0f + 250.0f) + 0.25f * (2.5f + 150.0f)));
}

TEST_CASE("maps: three channels get a name each") {
  TexturedSurface surface = twoVertices();
  lookUpMap("albedo", imageOf(8, 4, 3, [](int, int, int c) { return float(c + 1); }), true, surface);
  CHECK(surface.maps.size() == 3);
  CHECK(surface.maps.at("albedo_red")[0] == Approx(1.0f));
  CHECK(surface.maps.at("albedo_green")[1] == Approx(2.0f));
  CHECK(surface.maps.at("albedo_blue")[1] == Approx(3.0f));
}

TEST_CASE("maps: without pixels or without an exemplar's size they are refused") {
  TexturedSurface surface = twoVertices();
  CHECK_THROWS_AS(lookUpMap("a", {}, false, surface), std::invalid_argument);
  surface.exemplarWidth = 0;
  CHECK_THROWS_AS(lookUpMap("a", noiseImage(4, 4, 1, 1), false, surface), std::invalid_argument);
}
