#include "tools/report/preview.h"

#include "tests/scratch.h"
#include "tests/tools/halves.h"

#include <OpenImageIO/imagebuf.h>
#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;
namespace fs = std::filesystem;

namespace {

// Red on the left, blue on the right.
fs::path writeHalves(const fs::path& file, int width, int height) {
  return fluidtex::writeHalves(file, width, height, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
}

}  // namespace

TEST_CASE("preview: the same picture as JPEG, no wider than asked for, of its own aspect", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeHalves(scratch.path / "0001.png", 160, 80);
  for (const auto& [asked, width] :
       {std::pair{40, 40}, std::pair{100, 100}, std::pair{160, 160}, std::pair{400, 160}}) {
    CAPTURE(asked);
    const std::string bytes = tools::previewOf(picture, asked);
    CHECK_THAT(bytes, Catch::StartsWith("\xff\xd8\xff"));
    const fs::path file = scratch.path / (std::to_string(asked) + ".jpg");
    std::ofstream(file, std::ios::binary) << bytes;
    OIIO::ImageBuf small(file.string());
    REQUIRE(small.read(0, 0, true, OIIO::TypeDesc::FLOAT));
    CHECK(small.spec().width == width);
    CHECK(small.spec().height == width / 2);
    float left[3], right[3];
    small.getpixel(width / 4, width / 4, left, 3);
    small.getpixel(3 * width / 4, width / 4, right, 3);
    CHECK((left[0] > 0.9f && left[1] < 0.1f && left[2] < 0.1f));
    CHECK((right[0] < 0.1f && right[1] < 0.1f && right[2] > 0.9f));
  }
}

TEST_CASE("preview: names that other programs take for patterns are names", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeHalves(scratch.path / "a %04d [x] 'ü'.png", 32, 16);
  CHECK(tools::previewOf(picture, 16) == tools::previewOf(writeHalves(scratch.path / "b.png", 32, 16), 16));
}

TEST_CASE("preview: a picture that cannot be read is named", "[tools]") {
  const Scratch scratch;
  const fs::path picture = writeHalves(scratch.path / "0001.png", 160, 80);
  std::ofstream(scratch.path / "0002.png") << "no picture";
  std::ofstream(scratch.path / "0003.png", std::ios::binary) << readBytes(picture).substr(0, 40);
  for (const char* name : {"0000.png", "0002.png", "0003.png"}) {
    CHECK_THROWS_AS(tools::previewOf(scratch.path / name, 40), std::runtime_error);
    CHECK_THROWS_WITH(
        tools::previewOf(scratch.path / name, 40),
        Catch::StartsWith((scratch.path / name).string() + ": ffmpeg cannot read the picture: "));
  }
}
