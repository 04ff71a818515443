#include "tools/frames/check_drawn_maps.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using Catch::Matchers::Contains;

TEST_CASE("drawn maps: values of one channel can be drawn, others are refused by name", "[tools]") {
  texture::Exemplar exemplar;
  render::Options options;
  CHECK_NOTHROW(tools::checkDrawnMaps(options, exemplar));  // none is asked for
  texture::ExemplarMap& map = exemplar.maps["height"];
  map.holds = texture::MapHolds::values;
  const auto check = [&](const std::string& key) {
    INFO(key);
    map.image.channels = 1;
    CHECK_NOTHROW(tools::checkDrawnMaps(options, exemplar));
    map.image.channels = 3;
    CHECK_THROWS_AS(tools::checkDrawnMaps(options, exemplar), texture::ExemplarError);
    CHECK_THROWS_WITH(tools::checkDrawnMaps(options, exemplar), Contains(key + ": height has 3 channels"));
  };
  SECTION("relief") {
    options.bump.map = "height";
    check("render.bump.map");
    map.holds = texture::MapHolds::normals;
    CHECK_NOTHROW(tools::checkDrawnMaps(options, exemplar));
  }
  SECTION("displacement") {
    options.displacement.map = "height";
    check("render.displacement.map");
  }
  SECTION("heat") {
    options.material.heat = "height";
    CHECK_NOTHROW(tools::checkDrawnMaps(options, exemplar));  // nothing glows
    options.material.kind = render::MaterialKind::lava;
    check("render.material.heat");
  }
}
