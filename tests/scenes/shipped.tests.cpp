// The river, the pour and the drops, and the ground that is made for them.
#include "scenes/scene.h"
#include "scenes/terrain/terrain.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace fluidtex::scenes {

namespace {

std::vector<std::uint16_t> pixelsOf(const std::string& file, int& width, int& height) {
  const auto input = OIIO::ImageInput::open(file);
  REQUIRE(input);
  width = input->spec().width;
  height = input->spec().height;
  REQUIRE(input->spec().nchannels == 1);
  REQUIRE(input->spec().format == OIIO::TypeDesc::UINT16);
  std::vector<std::uint16_t> pixels(std::size_t(width) * std::size_t(height));
  REQUIRE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, pixels.data()));
  return pixels;
}

double heightAt(const terrain::Ground& ground, double x, double y) {
  const int column = static_cast<int>(x / ground.pixel),
            row = ground.height - 1 - static_cast<int>(y / ground.pixel);
  return ground.heights[std::size_t(row) * std::size_t(ground.width) + std::size_t(column)];
}

}  // namespace

TEST_CASE("shipped scenes: are read in every quality, with files that are there", "[scenes]") {
  for (const std::string file : {"river", "pour", "drops", "flows/deformation", "flows/stretch",
                                 "flows/source_sink", "flows/vortex", "flows/sphere", "flows/torus"}) {
    const std::string name = file.substr(file.find('/') + 1);
    for (const Quality quality : {Quality::preview, Quality::standard, Quality::final}) {
      Overrides overrides;
      overrides.quality = quality;
      const Scene scene = loadScene(FLUIDTEX_SOURCE_DIR "/scenes/" + file + ".toml", overrides);
      CHECK(scene.name == name);
      CHECK(std::filesystem::is_regular_file(scene.texture.exemplar.file));
      for (const sim::Solid& solid : scene.sim.solids) {
        if (const auto* ground = std::get_if<sim::HeightField>(&solid.shape.kind))
          CHECK(std::filesystem::is_regular_file(ground->file));
      }
    }
  }
}

TEST_CASE("terrain: the pictures that ship are those that are made", "[scenes]") {
  int width = 0, height = 0;
  const terrain::Ground bed = terrain::streamBed(), mountain = terrain::mountain();
  CHECK(pixelsOf(FLUIDTEX_SOURCE_DIR "/scenes/terrain/stream_bed.png", width, height) ==
        terrain::greyValues(bed, 0.0, 1.0));
  CHECK((width == bed.width && height == bed.height));
  CHECK(pixelsOf(FLUIDTEX_SOURCE_DIR "/scenes/terrain/mountain.png", width, height) ==
        terrain::greyValues(mountain, 0.0, 1.5));
  CHECK((width == mountain.width && height == mountain.height));
}

TEST_CASE("terrain: the stream bed falls from end to end between banks", "[scenes]") {
  const terrain::Ground bed = terrain::streamBed();
  const auto lowest = [&](double x) {
    double least = 1.0;
    for (double y = 0.01; y < 2.0; y += 0.02) least = std::min(least, heightAt(bed, x, y));
    return least;
  };
  CHECK(lowest(0.1) > lowest(2.0));
  CHECK(lowest(2.5) - lowest(2.95) > 0.1);  // the fall
  CHECK(lowest(2.95) + 0.02 > lowest(3.9));
  for (double x = 0.05; x < 4.0; x += 0.05) {
    INFO(x);
    CHECK(heightAt(bed, x, 0.02) - lowest(x) > 0.2);
    CHECK(heightAt(bed, x, 1.98) - lowest(x) > 0.2);
  }
}

TEST_CASE("terrain: the mountain has a crater that overflows through two gullies", "[scenes]") {
  const terrain::Ground mountain = terrain::mountain();
  const double floor = heightAt(mountain, 1.5, 1.5);
  CHECK(floor > 0.8);
  double highest = 0.0;
  for (const float height : mountain.heights) highest = std::max(highest, double(height));
  CHECK(highest - floor > 0.15);
  CHECK(highest < 1.5);
  // Around the rim, where lava seven centimetres deep gets over it.
  int places = 0;
  bool before = false;
  for (int degree = 0; degree < 360; degree += 2) {
    const double angle = degree * std::numbers::pi / 180.0;
    double rim = 0.0;
    for (double r = 0.2; r < 0.45; r += 0.01)
      rim = std::max(rim, heightAt(mountain, 1.5 + r * std::cos(angle), 1.5 + r * std::sin(angle)));
    const bool over = rim < floor + 0.07;
    places += over && !before ? 1 : 0;
    before = over;
  }
  CHECK(places == 2);
  for (double along = 0.05; along < 3.0; along += 0.1) {
    CHECK(heightAt(mountain, along, 0.01) < 0.45);
    CHECK(heightAt(mountain, 0.01, along) < 0.45);
  }
}

}  // namespace fluidtex::scenes
