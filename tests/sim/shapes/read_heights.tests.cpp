#include "sim/shapes/read_heights.h"

#include "tests/sim/meshes/written_files.h"
#include "tests/sim/shapes/ramp.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <string>

using namespace fluidtex::sim;

TEST_CASE("read heights: a file that is none is told of", "[sim]") {
  CHECK_THROWS_WITH(readHeights("nowhere.png"), "nowhere.png: no such file");
  CHECK_THROWS_AS(readHeights("."), HeightError);
  const WrittenFile text("text.pgm", "no picture"), dot("dot.pgm", "P5 1 1 255\nx");
  CHECK_THROWS_AS(readHeights(text.path), HeightError);
  CHECK_THROWS_AS(readHeights(dot.path), HeightError);
  const WrittenFile cut("cut.pgm", ramp().substr(0, 1000));
  CHECK_THROWS_AS(readHeights(cut.path), HeightError);
}

TEST_CASE("read heights: heights are as stored, upright, and filled where there are none", "[sim]") {
  // Rises from left to right; the right half nearly transparent.
  std::string grey, both;
  for (int n = 0; n < 64; ++n) {
    grey += static_cast<char>(30 * (n % 8) + n / 8);
    both += grey.back();
    both += static_cast<char>(n % 8 < 4 ? 255 : 10);
  }
  const auto heights = [](const std::string& bytes) {
    const WrittenFile file("heights.tif", bytes);
    return readHeights(file.path);
  };
  const auto value = [](const HeightImage& image, int column, int row) {
    return std::lround(255.0f * image.values[std::size_t(row * image.width + column)]);
  };
  for (const std::uint32_t alpha : {0u, 2u}) {  // not said, and not multiplied in
    const HeightImage image = heights(tiffBytes(8, 8, 8, 2, both, {{338, 3, alpha}}));
    for (int n = 0; n < 64; ++n) REQUIRE(value(image, n % 8, n / 8) == 30 * (n % 8) + n / 8);
  }
  // The eight ways to lie: where the stored first row and first column are in the upright picture (TIFF 6.0).
  for (std::uint32_t orientation = 1; orientation <= 8; ++orientation) {
    const HeightImage image = heights(tiffBytes(8, 4, 8, 1, grey.substr(0, 32), {{274, 3, orientation}}));
    REQUIRE(image.width == (orientation < 5 ? 8 : 4));
    REQUIRE(image.height == (orientation < 5 ? 4 : 8));
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 8; ++column) {
        const int right = 7 - column, bottom = 3 - row;
        const int x[8] = {column, right, right, column, row, bottom, bottom, row};
        const int y[8] = {row, row, bottom, bottom, column, column, right, right};
        CAPTURE(orientation, column, row);
        REQUIRE(value(image, x[orientation - 1], y[orientation - 1]) == 30 * column + row);
      }
    }
  }
  // GDAL_NODATA in whole numbers and in floats; another number as large as none is counts too.
  std::string holes = grey;
  holes[9] = holes[10] = '\xFF';
  const HeightImage filled = heights(tiffBytes(8, 8, 8, 1, holes, {{42113, 2, 0, "255"}}));
  CHECK(value(filled, 0, 1) == 1);
  CHECK((value(filled, 1, 1) == 1 || value(filled, 1, 1) == 30 || value(filled, 1, 1) == 32));
  CHECK(value(filled, 2, 1) != 255);
  for (const float hole : {-3.4028235e38f, -3.4e38f, -9999.0f}) {
    std::string floats;
    for (int n = 0; n < 64; ++n) append(floats, n < 16 ? hole : 0.4f);
    const std::string name = hole == -9999.0f ? "-9999" : "-3.4028234663852886e+38";
    const HeightImage image = heights(tiffBytes(8, 8, 32, 1, floats, {{339, 3, 3}, {42113, 2, 0, name}}));
    for (const float v : image.values) REQUIRE(v == 0.4f);
    if (hole > -1e30f) continue;
    CHECK_THROWS_WITH(
        heights(tiffBytes(8, 8, 32, 1, floats, {{339, 3, 3}})),
        Catch::Matchers::Contains("column 1 of row 1") && Catch::Matchers::Contains("GDAL_NODATA"));
  }
  CHECK_THROWS_WITH(heights(tiffBytes(8, 8, 8, 1, std::string(64, '\7'), {{42113, 2, 0, "7"}})),
                    Catch::Matchers::Contains("no height anywhere"));
}

TEST_CASE("read heights: a picture of any kind, and a library that falls over a damaged one", "[sim]") {
  const WrittenFile damaged("heights.sgi", sgiBytes(true)), whole("heights.sgi", sgiBytes(false));
  CHECK_THROWS_WITH(readHeights(damaged.path), Catch::Contains("cannot be read: the library that reads"));
  const HeightImage image = readHeights(whole.path);
  REQUIRE(image.values.size() == 64);
  for (int n = 0; n < 64; ++n)
    REQUIRE(std::lround(255.0f * image.values[std::size_t(n)]) == 30 * (n % 8) + (7 - n / 8));
}
