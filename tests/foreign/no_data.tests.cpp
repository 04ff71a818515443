#include "foreign/no_data.h"

#include "tests/scratch.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;

namespace {

std::optional<double> readFrom(const std::string& bytes) {
  const Scratch scratch;
  std::ofstream(scratch.path / "a.tif", std::ios::binary) << bytes;
  return foreign::noDataOf(scratch.path / "a.tif");
}

std::string tiffWith(const std::string& text) {
  return sim::tiffBytes(8, 8, 8, 1, std::string(64, '\7'), {{42113, 2, 0, text}});
}

}  // namespace

TEST_CASE("no data: the number that GDAL's tag holds, as it is written", "[foreign]") {
  CHECK(readFrom(tiffWith("255")) == 255.0);
  CHECK(readFrom(tiffWith("-9999.5 ")) == -9999.5);
  CHECK(readFrom(tiffWith("-3.4028234663852886e+38")) == -3.4028234663852886e+38);
  const std::optional<double> none = readFrom(tiffWith("nan"));
  REQUIRE(none);
  CHECK(std::isnan(*none));
}

TEST_CASE("no data: nothing where there is no such tag, no number in it, or no TIFF", "[foreign]") {
  CHECK_FALSE(readFrom(sim::tiffBytes(8, 8, 8, 1, std::string(64, '\7'), {})));
  CHECK_FALSE(readFrom(sim::tiffBytes(8, 8, 8, 1, std::string(64, '\7'), {{42112, 2, 0, "255"}})));
  CHECK_FALSE(readFrom(tiffWith("none at all")));
  CHECK_FALSE(readFrom(tiffWith("255").substr(0, 20)));
  CHECK_FALSE(readFrom("P5 8 8 255 255"));
  CHECK_FALSE(foreign::noDataOf("/nowhere/a.tif"));
}
