#include "render/render.h"

#include "tests/file_limit.h"
#include "tests/scratch.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::render;
namespace fs = std::filesystem;

TEST_CASE("png: flat sRGB colours come back exactly", "[render]") {
  // All 256 values of a channel: linear by the standard's own formula, in double.
  Picture picture{256, 3, {}};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 256; ++x)
      for (int k = 0; k < 3; ++k) {
        const double c = (k == y ? x : 255 - x) / 255.0;
        picture.rgb.push_back(
            static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4)));
      }
  const Scratch scratch;
  const fs::path file = scratch.path / "flat.png.tmp";
  writePng(picture, file);
  auto input = OIIO::ImageInput::open(file.string());
  REQUIRE(input);
  REQUIRE(std::string(input->format_name()) == "png");
  REQUIRE(input->spec().width == 256);
  REQUIRE(input->spec().height == 3);
  REQUIRE(input->spec().nchannels == 3);
  std::vector<std::uint8_t> pixels(256 * 3 * 3);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 256; ++x)
      for (int k = 0; k < 3; ++k) REQUIRE(pixels[(y * 256 + x) * 3 + k] == (k == y ? x : 255 - x));
}

TEST_CASE("png: values out of range are clipped", "[render]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "clipped.png";
  writePng({2, 1, {-1.0f, 2.0f, std::nanf(""), 1e30f, -0.0f, 1.0f}}, file);
  auto input = OIIO::ImageInput::open(file.string());
  std::vector<std::uint8_t> pixels(6);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
  REQUIRE(pixels == std::vector<std::uint8_t>{0, 255, 0, 255, 0, 255});
}

TEST_CASE("png: the same picture gives the same bytes", "[render]") {
  Picture picture{31, 17, std::vector<float>(31 * 17 * 3)};
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<float>(i % 97) / 97.0f;
  const Scratch scratch;
  writePng(picture, scratch.path / "a.png");
  writePng(picture, scratch.path / "b.png");
  REQUIRE(readBytes(scratch.path / "a.png").size() > 100);
  REQUIRE(readBytes(scratch.path / "a.png") == readBytes(scratch.path / "b.png"));
}

TEST_CASE("png: notes are found by another reader, in letters of any language", "[render]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "noted.png";
  writePng({2, 1, {0, 0, 0, 1, 1, 1}}, file,
           {{"Title", "Flüsse & Täler 50 %"}, {"Frame", "12"}, {"Empty", ""}});
  const auto input = OIIO::ImageInput::open(file.string());
  REQUIRE(input);
  // Its own names of the keywords that it knows.
  CHECK(input->spec().get_string_attribute("DocumentName") == "Flüsse & Täler 50 %");
  CHECK(input->spec().get_string_attribute("Frame") == "12");
  const std::string bytes = readBytes(file);
  CHECK(bytes.find(std::string("tEXtFrame\0"
                               "12",
                               12)) != bytes.npos);
  CHECK(bytes.find("iTXtTitle") != bytes.npos);
  CHECK(bytes.find("tIME") == bytes.npos);
}

TEST_CASE("png: a picture without pixels is refused", "[render]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(writePng({}, scratch.path / "none.png"),
                    Catch::Contains("none.png: the picture could not be written: "));
  CHECK_FALSE(fs::exists(scratch.path / "none.png"));
}

TEST_CASE("png: a place that cannot be written is named", "[render]") {
  REQUIRE_THROWS_WITH(writePng({1, 1, {0, 0, 0}}, "/nonexistent_folder/x.png"),
                      Catch::StartsWith("/nonexistent_folder/x.png: the picture could not be written: "));
}

TEST_CASE("png: a picture that the disk does not take to its last byte is a failure", "[render]") {
  const Scratch scratch;
  Picture picture{40, 30, std::vector<float>(40 * 30 * 3)};
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = float(i * 7919 % 1000) / 1000.0f;
  writePng(picture, scratch.path / "whole.png");
  const auto size = fs::file_size(scratch.path / "whole.png");
  for (const std::uintmax_t limit : {std::uintmax_t{1}, size / 2, size - 1}) {
    std::string what;
    try {
      const FileLimit less(limit);
      writePng(picture, scratch.path / "cut.png");
    } catch (const std::runtime_error& error) {
      what = error.what();
    }
    CHECK_THAT(what, Catch::Contains("cut.png: the picture could not be written: File too large"));
  }
}
