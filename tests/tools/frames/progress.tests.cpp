#include "tools/frames/progress.h"

#include <catch2/catch.hpp>

using fluidtex::tools::humanDuration;

TEST_CASE("progress: durations as people say them", "[tools]") {
  CHECK(humanDuration(45.0) == "45 s");
  CHECK(humanDuration(200.0) == "3 min 20 s");
  CHECK(humanDuration(2 * 3600.0 + 5 * 60.0) == "2 h 5 min");
}
