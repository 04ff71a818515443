#include "tools/summaries/contact_sheet.h"

#include "tests/scratch.h"

#include <OpenImageIO/imagebuf.h>
#include <catch2/catch.hpp>

#include <array>
#include <filesystem>

namespace fs = std::filesystem;
using namespace fluidtex::tools;

namespace {

fs::path writePicture(const fs::path& file, int width, int height, float red) {
  OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
  for (OIIO::ImageBuf::Iterator<std::uint8_t> pixel(image); !pixel.done(); ++pixel) pixel[0] = red;
  image.write(file.string());
  return file;
}

std::array<float, 3> pixelOf(const OIIO::ImageBuf& image, int x, int y) {
  std::array<float, 3> rgb{};
  image.getpixel(x, y, rgb.data(), 3);
  return rgb;
}

}  // namespace

TEST_CASE("contact sheet: pictures in rows, scaled alike, with their names", "[tools]") {
  const Scratch scratch;
  const fs::path light = writePicture(scratch.path / "a.png", 80, 40, 1.0f),
                 dark = writePicture(scratch.path / "b.png", 160, 80, 0.5f);
  const fs::path file = scratch.path / "sheet.png";
  writeContactSheets({{{{light, ""}, {dark, ""}, {light, "name"}}, 2, 100, file}});
  const OIIO::ImageBuf sheet(file.string());
  REQUIRE(sheet.spec().width % 2 == 0);
  REQUIRE(sheet.spec().height % 2 == 0);
  CHECK(sheet.spec().width >= 200);
  CHECK(sheet.spec().height >= 100);
  CHECK(pixelOf(sheet, 50, 25)[0] == Approx(1.0f).margin(0.02));
  CHECK(pixelOf(sheet, 154, 25)[0] == Approx(0.5f).margin(0.02));
  CHECK(pixelOf(sheet, 90, 90)[0] == Approx(1.0f).margin(0.02));
  CHECK(pixelOf(sheet, 154, 90)[0] == 0.0f);  // there is no fourth picture
  // Where the name stands there is something else than red.
  int lettered = 0;
  for (int y = 54; y < 70; ++y) {
    for (int x = 0; x < 60; ++x) lettered += pixelOf(sheet, x, y)[1] > 0.5f || pixelOf(sheet, x, y)[0] < 0.5f;
  }
  CHECK(lettered > 20);
  CHECK_THROWS_WITH(writeContactSheets({{{{scratch.path / "missing.png", ""}}, 1, 100, file}}),
                    Catch::Contains("missing.png"));
  CHECK_THROWS_AS(writeContactSheets({{{}, 1, 100, file}}), std::runtime_error);
}
