#include "foreign/layers.h"

#include <catch2/catch.hpp>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using Channels = std::vector<int>;

namespace {

Layer colors(const std::vector<Part>& parts) {
  return chooseLayer(parts, false);
}

void check(const Layer& layer, int part, const Channels& channels) {
  CHECK(layer.part == part);
  CHECK(layer.channels == channels);
}

}  // namespace

TEST_CASE("layers: R, G and B without a layer's name, in any order, with alpha", "[foreign]") {
  check(colors({{"", {"R", "G", "B"}}}), 0, {0, 1, 2});
  check(colors({{"", {"A", "B", "G", "R"}}}), 0, {3, 2, 1, 0});
  check(colors({{"", {"Z", "albedo.R", "albedo.G", "albedo.B", "red", "green", "blue"}}}), 0, {4, 5, 6});
}

TEST_CASE("layers: what is called RGB, beauty or Combined, wherever it stands", "[foreign]") {
  check(colors({{"", {"albedo.R", "albedo.G", "albedo.B", "rgba.R", "rgba.G", "rgba.B", "rgba.A"}}}), 0,
        {3, 4, 5, 6});
  check(colors(
            {{"",
              {"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G", "ViewLayer.Combined.R",
               "ViewLayer.Depth.Z", "ViewLayer.DiffCol.B", "ViewLayer.DiffCol.G", "ViewLayer.DiffCol.R"}}}),
        0, {3, 2, 1, 0});
  check(colors({{"", {"normal.R", "normal.G", "normal.B", "Beauty.red", "Beauty.green", "Beauty.blue"}}}), 0,
        {3, 4, 5});
}

TEST_CASE("layers: parts are told by their names", "[foreign]") {
  check(colors({{"depth", {"Z"}}, {"rgba", {"R", "G", "B"}}}), 1, {0, 1, 2});
  check(colors({{"albedo", {"R", "G", "B"}}, {"beauty", {"R", "G", "B", "A"}}}), 1, {0, 1, 2, 3});
  check(colors({{"deep", {}}, {"lights", {"R", "G", "B"}}}), 1, {0, 1, 2});  // the only one with colours
}

TEST_CASE("layers: where no single name tells, it is refused with the names", "[foreign]") {
  CHECK_THROWS_WITH(colors({{"", {"albedo.R", "albedo.G", "albedo.B", "normal.R", "normal.G", "normal.B"}}}),
                    Contains("several layers") && Contains("albedo, normal"));
  CHECK_THROWS_WITH(
      colors({{"left", {"rgba.R", "rgba.G", "rgba.B"}}, {"right", {"rgba.R", "rgba.G", "rgba.B"}}}),
      Contains("left.rgba, right.rgba"));
  CHECK_THROWS_WITH(colors({{"", {"Z"}}}), Contains("no layer of colours") && Contains("z"));
  CHECK_THROWS_WITH(colors({{"", {"ViewLayer.Depth.V"}}}), Contains("ViewLayer.Depth"));
  CHECK_THROWS_WITH(colors({{"", {"N.X", "N.Y", "N.Z"}}}), Contains("no layer of colours: N"));
  std::vector<std::string> many;
  for (int i = 0; i < 5000; ++i)
    for (const char* c : {".R", ".G", ".B"}) many.push_back(std::string(200, 'x') + std::to_string(i) + c);
  try {
    colors({{"", many}});
    FAIL();
  } catch (const Unreadable& error) {
    CHECK(std::string(error.what()).size() < 1000);
    CHECK_THAT(error.what(), Contains("and 4992 more"));
  }
}

TEST_CASE("layers: grey, and as numbers normals and depth too", "[foreign]") {
  check(colors({{"", {"Y"}}}), 0, {0});
  check(colors({{"", {"A", "Y"}}}), 0, {1, 0});
  check(colors({{"", {"height"}}}), 0, {0});
  check(colors({{"", {"Y", "Z"}}}), 0, {0});
  check(chooseLayer({{"", {"Z"}}}, true), 0, {0});
  check(chooseLayer({{"", {"N.X", "N.Y", "N.Z"}}}, true), 0, {0, 1, 2});
  check(chooseLayer({{"", {"R", "G", "B", "N.X", "N.Y", "N.Z"}}}, true), 0, {0, 1, 2});
}
