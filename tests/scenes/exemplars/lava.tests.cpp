#include "scenes/exemplars/lava.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace fluidtex::exemplars {

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

TEST_CASE("lava: the seed alone decides", "[scenes]") {
  const Lava options{.size = 48, .plates = 5}, other{.size = 48, .plates = 5, .seed = 12};
  const Pixels pixels = makeLava(options);
  CHECK(pixels.size() == 3 * 48 * 48);
  CHECK((pixels == makeLava(options)));
  CHECK((pixels != makeLava(other)));
}

TEST_CASE("cooling lava: both images are toroidal", "[scenes]") {
  const Lava options{.size = 96, .plates = 5};
  const CoolingLava lava = makeCoolingLava(options);
  const int size = options.size;
  REQUIRE(lava.guidance.size() == std::size_t(size) * std::size_t(size));
  Pixels grey;  // as step() takes it
  for (const std::uint8_t level : lava.guidance) grey.insert(grey.end(), 3, level);
  for (const Pixels* pixels : {&lava.pixels, static_cast<const Pixels*>(&grey)}) {
    for (const bool columns : {true, false}) {
      // Lines that do not belong together differ by more than twice as much.
      CHECK(step(*pixels, size, size - 1, 0, columns) < 0.5 * step(*pixels, size, size / 2, 0, columns));
    }
  }
}

TEST_CASE("lava: its stages of cooling have the same plates, and glow the more the more molten", "[scenes]") {
  CHECK((shipped("lava_stages/0000.png", kLavaStages.size) == makeLavaAtStage(0.0, kLavaStages)));
  CHECK((shipped("lava_stages/0011.png", kLavaStages.size) == makeLavaAtStage(1.0, kLavaStages)));
  const Lava options{.size = 64, .plates = 4, .samples = 1};
  double before = -1.0;
  Pixels last;
  for (const double stage : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Pixels pixels = makeLavaAtStage(stage, options);
    double red = 0.0;
    std::size_t darker = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
      red += pixels[i];
      if (!last.empty() && pixels[i] + 12 < last[i]) ++darker;
    }
    CHECK(red > before);
    // A place that glows does not go dark where it gets hotter.
    CHECK(darker < pixels.size() / 3 / 50);
    before = red;
    last = pixels;
  }
}

}  // namespace fluidtex::exemplars
