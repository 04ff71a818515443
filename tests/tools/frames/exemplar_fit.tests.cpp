#include "tools/frames/exemplar_fit.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using Catch::Contains;

TEST_CASE("exemplar fit: what is offered would fit", "[tools]") {
  texture::Options options;
  options.exemplar.file = "photographs/bark.jpg";
  const std::string note = tools::fitNote(options, 320, 320, 8000);
  CHECK_THAT(note, Contains("7.8% of bark.jpg's 320 x 320 pixels") && Contains("about 89 x 89 pixels") &&
                       Contains("--set texture.points=110000"));
  CHECK(tools::fitNote(options, 89, 89, 8000).empty());
  CHECK(tools::fitNote(options, 320, 320, 110000).empty());
  // A wide one keeps its shape, and none gets smaller than an exemplar may be.
  CHECK_THAT(tools::fitNote(options, 640, 160, 8000), Contains("about 179 x 45 pixels"));
  CHECK_THAT(tools::fitNote(options, 400, 400, 500), Contains("about 33 x 33 pixels"));
  // Where the distance of points is given, it is what is offered: the same factor.
  options.spacing = 0.01;
  CHECK_THAT(tools::fitNote(options, 400, 400, 10000), Contains("--set texture.spacing=0.0025"));
  options.synthesis.method = texture::Method::none;
  CHECK(tools::fitNote(options, 320, 320, 8000).empty());
  CHECK(tools::fitNote(options, 320, 320, 0).empty());
}
