#include "tools/frames/check_relief.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using Catch::Matchers::Contains;

TEST_CASE("check relief: values of one channel or normals can be drawn, others are refused by name",
          "[tools]") {
  texture::Exemplar exemplar;
  render::Bump bump;
  CHECK_NOTHROW(tools::checkRelief(bump, exemplar));  // none is asked for
  bump.map = "height";
  texture::ExemplarMap& map = exemplar.maps["height"];
  map.holds = texture::MapHolds::values;
  map.image.channels = 1;
  CHECK_NOTHROW(tools::checkRelief(bump, exemplar));
  map.image.channels = 3;
  CHECK_THROWS_AS(tools::checkRelief(bump, exemplar), texture::ExemplarError);
  CHECK_THROWS_WITH(tools::checkRelief(bump, exemplar), Contains("height has 3 channels"));
  map.holds = texture::MapHolds::normals;
  CHECK_NOTHROW(tools::checkRelief(bump, exemplar));
}
