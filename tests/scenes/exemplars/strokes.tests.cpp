#include "scenes/exemplars/strokes.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

namespace fluidtex::exemplars {

TEST_CASE("strokes: the picture that ships is the generator's", "[scenes]") {
  const Strokes options;
  CHECK((shipped("strokes.png", options.size, 3) == makeStrokes(options)));
}

TEST_CASE("strokes: toroidal in both directions", "[scenes]") {
  const Strokes options{.size = 128, .samples = 1};
  CHECK(isToroidal(makeStrokes(options), options.size, 3));
}

}  // namespace fluidtex::exemplars
