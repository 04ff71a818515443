#include "scenes/exemplars/leaves.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

namespace fluidtex::exemplars {

TEST_CASE("leaves: the picture that ships is the generator's", "[scenes]") {
  const Leaves options;
  CHECK((shipped("leaves.png", options.size, 4) == makeLeaves(options)));
}

TEST_CASE("leaves: toroidal in both directions", "[scenes]") {
  const Leaves options{.size = 128, .samples = 1};
  CHECK(isToroidal(makeLeaves(options), options.size, 4));
}

TEST_CASE("leaves: cover about half, and are cut out clean", "[scenes]") {
  const Leaves options{.size = 256};
  const Pixels pixels = makeLeaves(options);
  int covered = 0, between = 0;
  for (std::size_t i = 3; i < pixels.size(); i += 4) {
    covered += pixels[i] == 255;
    between += pixels[i] > 0 && pixels[i] < 255;
    if (pixels[i] > 0) CHECK(int(pixels[i - 3]) + int(pixels[i - 2]) > 20);  // no dark fringe
  }
  const double all = double(pixels.size()) / 4.0;
  CHECK(covered / all > 0.35);
  CHECK(covered / all < 0.65);
  CHECK(between / all < 0.2);
}

}  // namespace fluidtex::exemplars
