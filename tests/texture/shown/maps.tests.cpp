#include "texture/shown/maps.h"

#include "tests/scratch.h"
#include "tests/texture/exemplar/test_images.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Two vertices on an exemplar of 8 x 4 texels; the second one still shows a quarter of its former place.
TexturedSurface twoVertices() {
  TexturedSurface surface;
  surface.exemplarWidth = 8;
  surface.exemplarHeight = 4;
  surface.positions.resize(2);
  surface.coordinate = {{2.0f, 1.0f}, {5.5f, 2.0f}};
  surface.fading = noFading(2);
  surface.fading.coordinate[1] = {2.0f, 1.0f};
  surface.fading.weight[1] = 0.25f;
  return surface;
}

}  // namespace

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

TEST_CASE("maps: a picture whose channels are all alike is one map, but not of vectors") {
  const Scratch scratch;
  const auto load = [&](MapHolds holds, std::uint8_t lastBlue) {
    std::vector<std::uint8_t> pixels;
    for (int p = 0; p < 8 * 4; ++p) pixels.insert(pixels.end(), 3, std::uint8_t(8 * p));
    pixels.back() = lastBlue;
    const std::string file = (scratch.path / "map.png").string();
    const auto out = OIIO::ImageOutput::create(file);
    REQUIRE(out);
    REQUIRE(out->open(file, OIIO::ImageSpec(8, 4, 3, OIIO::TypeDesc::UINT8)));
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
    REQUIRE(out->close());
    MapOptions options;
    options.file = file;
    options.holds = holds;
    return loadMap(options, 8, true).image;
  };
  const Image grey = load(MapHolds::values, 8 * 31);
  REQUIRE(grey.channels == 1);
  REQUIRE(grey.data.size() == 8 * 4);
  for (int p = 0; p < 8 * 4; ++p) CHECK(grey.data[std::size_t(p)] == Approx(8 * p / 255.0));
  CHECK(load(MapHolds::values, 8 * 31 + 1).channels == 3);
  CHECK(load(MapHolds::normals, 8 * 31).channels == 3);
}

TEST_CASE("maps: a fine map is reduced to what vertices can show, its mean kept") {
  const Image fine = noiseImage(64, 32, 1, 3), reduced = vertexMap(fine, 8, true);
  CHECK(reduced.width == 8);
  CHECK(reduced.height == 4);
  const auto mean = [](const Image& image) {
    double sum = 0.0;
    for (const float value : image.data) sum += double(value);
    return sum / double(image.data.size());
  };
  CHECK(mean(reduced) == Approx(mean(fine)));
  CHECK(vertexMap(fine, 40, true).width == 64);
}

TEST_CASE("maps: without pixels or without an exemplar's size they are refused") {
  TexturedSurface surface = twoVertices();
  CHECK_THROWS_AS(lookUpMap("a", {}, false, surface), std::invalid_argument);
  surface.exemplarWidth = 0;
  CHECK_THROWS_AS(lookUpMap("a", noiseImage(4, 4, 1, 1), false, surface), std::invalid_argument);
}
