#include "tools/sheet/draw_sheet.h"

#include "tests/scratch.h"

#include <OpenImageIO/imagebuf.h>
#include <catch2/catch.hpp>

#include <array>

using namespace fluidtex::tools;
namespace fs = std::filesystem;

namespace {

fs::path writeGrey(const fs::path& file, int width, int height, float grey) {
  OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
  for (OIIO::ImageBuf::Iterator<std::uint8_t> pixel(image); !pixel.done(); ++pixel)
    for (int c = 0; c < 3; ++c) pixel[c] = grey;
  REQUIRE(image.write(file.string()));
  return file;
}

float greyAt(const OIIO::ImageBuf& image, int x, int y) {
  std::array<float, 3> rgb{};
  image.getpixel(x, y, rgb.data(), 3);
  CHECK(rgb[0] == rgb[1]);
  CHECK(rgb[1] == rgb[2]);
  return rgb[0];
}

}  // namespace

TEST_CASE("draw sheet: pictures lie in rows, of the first one's aspect, with a gap between", "[tools]") {
  const Scratch scratch;
  const fs::path wide = writeGrey(scratch.path / "wide.png", 60, 30, 1.0f),
                 high = writeGrey(scratch.path / "high.png", 30, 90, 0.6f), file = scratch.path / "sheet.png";
  drawSheet({{{wide, ""}, {high, ""}, {high, ""}, {wide, ""}, {high, ""}}, 2, 40, file});
  const OIIO::ImageBuf sheet(file.string());
  CHECK(sheet.spec().width == 2 * 44);
  CHECK(sheet.spec().height == 3 * 24);
  for (int n = 0; n < 5; ++n) {
    const int x = n % 2 * 44, y = n / 2 * 24;
    const float grey = n == 0 || n == 3 ? 1.0f : 0.6f;
    for (const auto& [dx, dy] :
         {std::pair{0, 0}, std::pair{39, 0}, std::pair{0, 19}, std::pair{39, 19}, std::pair{20, 10}})
      CHECK(greyAt(sheet, x + dx, y + dy) == Approx(grey).margin(0.01));
    CHECK(greyAt(sheet, x + 41, y + 10) == 0.0f);
    CHECK(greyAt(sheet, x + 20, y + 21) == 0.0f);
  }
  CHECK(greyAt(sheet, 44 + 20, 48 + 10) == 0.0f);  // there is no sixth
}

TEST_CASE("draw sheet: its sides are even, as a video needs them", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeGrey(scratch.path / "a.png", 30, 20, 0.5f);
  for (const int width : {33, 34, 35, 3}) {
    const fs::path file = scratch.path / (std::to_string(width) + ".png");
    drawSheet({{{picture, ""}, {picture, ""}, {picture, ""}}, 3, width, file});
    const OIIO::ImageBuf sheet(file.string());
    const int height = std::max(2, width * 20 / 30);
    CHECK(sheet.spec().width == (3 * (width + 4) + 1) / 2 * 2);
    CHECK(sheet.spec().height == (height + 4 + 1) / 2 * 2);
  }
}

TEST_CASE("draw sheet: a label changes its own corner alone", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeGrey(scratch.path / "a.png", 200, 100, 0.5f),
                 file = scratch.path / "sheet.png";
  drawSheet({{{picture, ""}, {picture, "name"}}, 2, 200, file});
  const OIIO::ImageBuf sheet(file.string());
  int lettered = 0, elsewhere = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 404; ++x) {
      if (x >= 200 && x < 204) continue;
      const bool changed = std::abs(greyAt(sheet, x, y) - 0.5f) > 0.02f;
      lettered += changed && x >= 204 && x < 254 && y < 25;
      elsewhere += changed && !(x >= 204 && x < 254 && y < 25);
    }
  }
  CHECK(lettered > 40);
  CHECK(elsewhere == 0);
}

TEST_CASE("draw sheet: what cannot be read or written is named, and an earlier sheet stays", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeGrey(scratch.path / "a.png", 30, 20, 0.5f), file = scratch.path / "sheet.png";
  std::ofstream(scratch.path / "torn.png") << "no picture";
  std::ofstream(file) << "earlier";
  CHECK_THROWS_WITH(drawSheet({{}, 1, 40, file}),
                    Catch::StartsWith(file.string() + ": there are no pictures"));
  for (const char* name : {"none.png", "torn.png"})
    CHECK_THROWS_WITH(drawSheet({{{picture, ""}, {scratch.path / name, ""}}, 2, 40, file}),
                      Catch::StartsWith((scratch.path / name).string() + ": "));
  CHECK(readBytes(file) == "earlier");
  CHECK_THROWS_WITH(drawSheet({{{picture, ""}}, 1, 40, scratch.path / "sheet.unknown"}),
                    Catch::Contains("sheet.unknown"));
}
