#include "scenes/exemplars/foam.h"
#include "scenes/exemplars/lava.h"
#include "scenes/exemplars/scales.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>

namespace fluidtex::exemplars {

namespace {

using Pixels = std::vector<std::uint8_t>;

Scales small() {
  Scales options;
  options.size = 96;
  options.columns = 6;
  options.rows = 8;
  options.samples = 3;
  return options;
}

// Mean absolute difference between each pixel of line a and its neighbour in line b; lines are columns or
// rows.
double step(const Pixels& pixels, int size, int a, int b, bool columns) {
  double sum = 0.0;
  for (int i = 0; i < size; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto at = [&](int line) {
        const int x = columns ? line : i, y = columns ? i : line;
        return int(pixels[std::size_t((y * size + x) * 3 + channel)]);
      };
      sum += std::abs(at(a) - at(b));
    }
  }
  return sum / (size * 3.0);
}

// The pixels of a square image that ships.
Pixels shipped(const std::string& name, int size, int channels = 3) {
  const auto input = OIIO::ImageInput::open(FLUIDTEX_SOURCE_DIR "/scenes/exemplars/" + name);
  REQUIRE(input);
  REQUIRE(input->spec().width == size);
  REQUIRE(input->spec().height == size);
  REQUIRE(input->spec().nchannels == channels);
  Pixels pixels(std::size_t(size) * size * channels);
  REQUIRE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data()));
  return pixels;
}

}  // namespace

TEST_CASE("green scales: the image that ships is the generator's, pixel by pixel", "[scenes]") {
  const Scales options;
  CHECK((shipped("green_scales.png", options.size) == makeGreenScales(options)));
}

TEST_CASE("green scales: the heights that ship are the generator's, high and low, and toroidal", "[scenes]") {
  const Scales options;
  const int size = options.size;
  const Pixels heights = shipped("green_scales_height.png", size, 1);
  CHECK((heights == makeScalesHeight(options)));
  CHECK(std::count_if(heights.begin(), heights.end(), [](int level) { return level < 32; }) >
        size * size / 50);
  CHECK(std::count_if(heights.begin(), heights.end(), [](int level) { return level > 160; }) >
        size * size / 10);
  const auto step = [&](int a, int b) {
    double sum = 0.0;
    for (int i = 0; i < size; ++i)
      sum += std::abs(int(heights[std::size_t(a * size + i)]) - int(heights[std::size_t(b * size + i)]));
    return sum;
  };
  double largest = 0.0;
  for (int row = 0; row + 1 < size; ++row) largest = std::max(largest, step(row, row + 1));
  CHECK(step(size - 1, 0) <= largest);
}

TEST_CASE("green scales: toroidal, the step over each edge is one of the usual steps", "[scenes]") {
  const int size = small().size;
  const Pixels pixels = makeGreenScales(small());
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < size; ++i) largest = std::max(largest, step(pixels, size, i, i + 1, columns));
    CHECK(step(pixels, size, size - 1, 0, columns) <= largest);
    CHECK(step(pixels, size, size / 2 + 5, 0, columns) > 0.0);
  }
}

TEST_CASE("green scales: the seed alone decides", "[scenes]") {
  Scales other = small();
  CHECK((makeGreenScales(small()) == makeGreenScales(other)));
  other.seed = small().seed + 1;
  CHECK((makeGreenScales(small()) != makeGreenScales(other)));
}

TEST_CASE("green scales: green, neither black nor white, with light and dark", "[scenes]") {
  const Pixels pixels = makeGreenScales(small());
  double sum[3] = {0.0, 0.0, 0.0};
  int darkest = 255, brightest = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    sum[i % 3] += pixels[i];
    if (i % 3 == 1) {
      darkest = std::min(darkest, int(pixels[i]));
      brightest = std::max(brightest, int(pixels[i]));
    }
  }
  CHECK(sum[1] > 1.3 * sum[0]);
  CHECK(sum[0] > sum[2]);
  CHECK(darkest < 60);
  CHECK(brightest > 150);
  CHECK(brightest < 255);
}

TEST_CASE("lava: the image that ships is the generator's, pixel by pixel", "[scenes]") {
  const Lava options;
  CHECK((shipped("lava.png", options.size) == makeLava(options)));
}

TEST_CASE("lava: toroidal, mostly dark crust, and what glows is red before it is yellow", "[scenes]") {
  const Lava options{.size = 96, .plates = 5};
  const Pixels pixels = makeLava(options);
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < options.size; ++i)
      largest = std::max(largest, step(pixels, options.size, i, i + 1, columns));
    CHECK(step(pixels, options.size, options.size - 1, 0, columns) <= largest);
  }
  int dark = 0, bright = 0;
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    const int red = pixels[i], green = pixels[i + 1], blue = pixels[i + 2];
    dark += red < 90;
    bright += red > 200;
    if (red > 120) {
      CHECK(red > green);
      CHECK(green >= blue);
    }
  }
  CHECK(dark > 0.5 * options.size * options.size);
  CHECK(bright > 0.02 * options.size * options.size);
}

TEST_CASE("cooling lava: the images that ship are the generator's, the higher the level, the more glows",
          "[scenes]") {
  const int size = kCooling.size;
  const CoolingLava lava = makeCoolingLava();
  CHECK((shipped("lava_cooling.png", size) == lava.pixels));
  CHECK((shipped("lava_cooling_guidance.png", size, 1) == lava.guidance));
  double glowing[4] = {}, count[4] = {};
  for (std::size_t i = 0; i < lava.guidance.size(); ++i) {
    const std::size_t stage = lava.guidance[i] / 64;
    count[stage] += 1.0;
    glowing[stage] += lava.pixels[3 * i] > 150;
  }
  for (int stage = 0; stage < 4; ++stage) CHECK(count[stage] > 0.1 * size * size);
  CHECK(glowing[0] == 0.0);
  for (int stage = 1; stage < 4; ++stage)
    CHECK(glowing[stage] / count[stage] > glowing[stage - 1] / count[stage - 1] + 0.05);
  CHECK(glowing[3] > 0.7 * count[3]);
}

TEST_CASE("foam: the images that ship are the generator's, toroidal, the higher the level, the more is white",
          "[scenes]") {
  const FoamyWater options;
  const FoamImages foam = makeFoam(options);
  CHECK((shipped("foam.png", options.size) == foam.pixels));
  CHECK((shipped("foam_guidance.png", options.size, 1) == foam.guidance));
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < options.size; ++i)
      largest = std::max(largest, step(foam.pixels, options.size, i, i + 1, columns));
    CHECK(step(foam.pixels, options.size, options.size - 1, 0, columns) <= largest);
  }
  double white[4] = {}, count[4] = {};
  for (std::size_t i = 0; i < foam.guidance.size(); ++i) {
    const std::size_t stage = foam.guidance[i] / 64;
    count[stage] += 1.0;
    white[stage] += foam.pixels[3 * i] > 150;
  }
  for (int stage = 0; stage < 4; ++stage) CHECK(count[stage] > 0.1 * options.size * options.size);
  CHECK(white[0] < 0.05 * count[0]);
  for (int stage = 1; stage < 4; ++stage)
    CHECK(white[stage] / count[stage] > white[stage - 1] / count[stage - 1] + 0.05);
  CHECK(white[3] > 0.85 * count[3]);
}

}  // namespace fluidtex::exemplars
