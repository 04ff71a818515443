#include "texture/exemplar/load_map.h"

#include "tests/scratch.h"
#include "tests/texture/exemplar/test_images.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// A file of 8 x 4 pixels.
std::filesystem::path writtenMap(const Scratch& scratch, const std::string& name, int channels,
                                 const std::vector<std::uint8_t>& pixels) {
  const std::filesystem::path file = scratch.path / name;
  const auto out = OIIO::ImageOutput::create(file.string());
  REQUIRE(out);
  REQUIRE(out->open(file.string(), OIIO::ImageSpec(8, 4, channels, OIIO::TypeDesc::UINT8)));
  REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
  REQUIRE(out->close());
  return file;
}

}  // namespace

TEST_CASE("maps: a picture whose channels are all alike is one map, but not of vectors") {
  const Scratch scratch;
  const auto load = [&](MapHolds holds, std::uint8_t lastBlue) {
    std::vector<std::uint8_t> pixels;
    for (int p = 0; p < 8 * 4; ++p) pixels.insert(pixels.end(), 3, std::uint8_t(8 * p));
    pixels.back() = lastBlue;
    MapOptions options;
    options.file = writtenMap(scratch, "map.png", 3, pixels);
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

TEST_CASE("load map: halved until less than twice as wide as the exemplar, but to no less than a pixel") {
  const auto widthOf = [](int width, int height, int exemplar) {
    const Image map = vertexMap(noiseImage(width, height, 1, 1), exemplar, false);
    CHECK(map.data.size() == std::size_t(map.width * map.height));
    return map.width;
  };
  CHECK(widthOf(63, 32, 32) == 63);
  CHECK(widthOf(64, 32, 32) == 32);
  CHECK(widthOf(127, 60, 32) == 32);  // 127, 64, 32
  CHECK(widthOf(20, 20, 32) == 20);
  CHECK(widthOf(64, 1, 8) == 64);
  CHECK(widthOf(64, 4, 8) == 16);
}

TEST_CASE("load map: what it holds and its weight are passed on, and grey has no vectors") {
  const Scratch scratch;
  MapOptions options{"lie", writtenMap(scratch, "grey.png", 1, std::vector<std::uint8_t>(32, 51)),
                     MapHolds::values, 0.75};
  const ExemplarMap map = loadMap(options, 8, false);
  CHECK(map.holds == MapHolds::values);
  CHECK(map.weight == 0.75f);
  CHECK(map.image.channels == 1);
  CHECK(loadMap(options, 4, false).image.width == 4);
  options.holds = MapHolds::normals;
  CHECK_THROWS_AS(loadMap(options, 8, false), ExemplarError);
  CHECK_THROWS_WITH(loadMap(options, 8, false), StartsWith(options.file.string()) && Contains("grey"));
  options.file = writtenMap(scratch, "color.png", 3, std::vector<std::uint8_t>(96, 51));
  CHECK(loadMap(options, 8, false).holds == MapHolds::normals);
  options.file = scratch.path / "none.png";
  CHECK_THROWS_AS(loadMap(options, 8, false), ExemplarError);
}

TEST_CASE("load map: channels are named by their colours where there are three") {
  CHECK(mapNames("height", 1) == std::vector<std::string>{"height"});
  CHECK(mapNames("a", 3) == std::vector<std::string>{"a_red", "a_green", "a_blue"});
}
