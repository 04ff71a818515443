#include "scenes/exemplars/foam.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace fluidtex::exemplars {

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
