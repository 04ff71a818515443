#include "sim/grid/require.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("require: throws the sentence, and only where the contract is not kept", "[sim]") {
  CHECK_NOTHROW(require(true, "unused"));
  CHECK_THROWS_AS(require(false, "dt must be positive"), std::invalid_argument);
  CHECK_THROWS_WITH(require(false, "dt must be positive"), "dt must be positive");
  const double dt = std::nan("");
  CHECK_THROWS_AS(require(dt > 0.0, "dt must be positive"), std::invalid_argument);
}
