#include "scenes/terrain/terrain.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace fluidtex::terrain {

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

double heightAt(const Ground& ground, double x, double y) {
  const int column = static_cast<int>(x / ground.pixel),
            row = ground.height - 1 - static_cast<int>(y / ground.pixel);
  return ground.heights[std::size_t(row) * std::size_t(ground.width) + std::size_t(column)];
}

}  // namespace

TEST_CASE("terrain: the pictures that ship are those that are made", "[scenes]") {
  int width = 0, height = 0;
  const Ground bed = terrain::streamBed(), mountain = terrain::mountain();
  CHECK(pixelsOf(FLUIDTEX_SOURCE_DIR "/scenes/terrain/stream_bed.png", width, height) ==
        greyValues(bed, 0.0, 1.0));
  CHECK((width == bed.width && height == bed.height));
  CHECK(pixelsOf(FLUIDTEX_SOURCE_DIR "/scenes/terrain/mountain.png", width, height) ==
        greyValues(mountain, 0.0, 1.5));
  CHECK((width == mountain.width && height == mountain.height));
}

TEST_CASE("terrain: the stream bed falls from end to end between banks", "[scenes]") {
  const Ground bed = terrain::streamBed();
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
  const Ground mountain = terrain::mountain();
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

TEST_CASE("terrain: heights are those that are promised, rows from high y to low", "[scenes]") {
  const Ground bed = streamBed(), top = mountain();
  CHECK((bed.width * bed.pixel == 4.0 && bed.height * bed.pixel == 2.0));
  CHECK((top.width * top.pixel == 3.0 && top.height * top.pixel == 3.0));
  for (const Ground* ground : {&bed, &top})
    CHECK(ground->heights.size() == std::size_t(ground->width) * std::size_t(ground->height));
  for (const double x : {0.01, 1.9, 3.99}) {
    double floor = 1.0;
    for (double y = 0.01; y < 2.0; y += 0.01) floor = std::min(floor, heightAt(bed, x, y));
    CHECK(floor == Approx(x < 1.0 ? 0.40 : x < 3.0 ? 0.36 : 0.18).margin(0.015));
  }
  CHECK(heightAt(top, 1.5, 1.5) == Approx(0.86).margin(0.005));
  const auto rim = [&](double degree) {
    const double angle = degree * std::numbers::pi / 180.0;
    return heightAt(top, 1.5 + 0.31 * std::cos(angle), 1.5 + 0.31 * std::sin(angle));
  };
  for (double degree = 0.0; degree < 210.0; degree += 10.0) CHECK(rim(degree) == Approx(1.02).margin(0.01));
  for (const double notch : {261.0, 320.0}) CHECK(rim(notch) < 0.94);
  double low = 1.0, high = 0.0;
  for (double along = 0.01; along < 3.0; along += 0.02) {
    for (const double side : {0.01, 2.99}) {
      low = std::min({low, heightAt(top, along, side), heightAt(top, side, along)});
      high = std::max({high, heightAt(top, along, side), heightAt(top, side, along)});
    }
  }
  CHECK(low == Approx(0.02));
  CHECK(high == Approx(0.16).margin(0.005));
}

TEST_CASE("terrain: grey goes from the low height to the high one, and is cut off beyond", "[scenes]") {
  Ground ground;
  ground.width = 6;
  ground.height = 1;
  ground.heights = {-5.0f, 1.0f, 1.5f, 2.0f, 3.0f, 7.0f};
  CHECK(greyValues(ground, 1.0, 3.0) == std::vector<std::uint16_t>{0, 0, 16384, 32768, 65535, 65535});
}

}  // namespace fluidtex::terrain
