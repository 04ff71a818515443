#include "scenes/exemplars/stones.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

namespace fluidtex::exemplars {

TEST_CASE("stones: the pictures that ship are the generator's", "[scenes]") {
  const Stones options;
  const StoneImages images = makeStones(options);
  CHECK((shipped("stones.png", options.size, 4) == images.pixels));
  CHECK((shipped("stones_height.png", options.size, 1) == images.height));
}

TEST_CASE("stones: toroidal in both directions, and high where they are seen", "[scenes]") {
  const Stones options{.size = 128, .samples = 1};
  const StoneImages images = makeStones(options);
  CHECK(isToroidal(images.pixels, options.size, 4));
  CHECK(isToroidal(images.height, options.size, 1));
  for (std::size_t i = 0; i < images.height.size(); ++i)
    CHECK((images.height[i] > 0) <= (images.pixels[4 * i + 3] > 0));
}

}  // namespace fluidtex::exemplars
