#include "scenes/write_png.h"

#include "tests/file_limit.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace fluidtex;
using Catch::Contains;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

// What goes to stderr for as long as it lives.
class HeardErrors {
 public:
  HeardErrors() : m_before(std::cerr.rdbuf(m_heard.rdbuf())) {}
  ~HeardErrors() { std::cerr.rdbuf(m_before); }
  HeardErrors(const HeardErrors&) = delete;
  HeardErrors& operator=(const HeardErrors&) = delete;
  std::string text() const { return m_heard.str(); }

 private:
  std::ostringstream m_heard;
  std::streambuf* m_before;
};

template <class Value>
std::vector<Value> pixelsOf(const std::filesystem::path& file, const ImageSpec& wanted) {
  const auto input = OIIO::ImageInput::open(file.string());
  REQUIRE(input);
  CHECK(std::string(input->format_name()) == "png");
  REQUIRE(input->spec().width == wanted.width);
  REQUIRE(input->spec().height == wanted.height);
  REQUIRE(input->spec().nchannels == wanted.nchannels);
  REQUIRE(input->spec().format == wanted.format);
  std::vector<Value> pixels(std::size_t(wanted.width) * std::size_t(wanted.height) *
                            std::size_t(wanted.nchannels));
  REQUIRE(input->read_image(0, 0, 0, wanted.nchannels, wanted.format, pixels.data()));
  return pixels;
}

}  // namespace

TEST_CASE("write png: bytes and words come back as they were, row by row", "[scenes]") {
  const Scratch scratch;
  const HeardErrors errors;
  std::vector<std::uint8_t> colors;
  for (int i = 0; i < 5 * 3 * 3; ++i) colors.push_back(std::uint8_t(i * 37));
  const ImageSpec bytes(5, 3, 3, TypeDesc::UINT8);
  const std::filesystem::path a = scratch.path / "a.png", b = scratch.path / "b.png";
  CHECK(scenes::writePng(a.string(), bytes, colors.data()));
  CHECK(pixelsOf<std::uint8_t>(a, bytes) == colors);
  const std::vector<std::uint16_t> heights{0, 1, 255, 256, 40000, 65535};
  const ImageSpec words(2, 3, 1, TypeDesc::UINT16);
  CHECK(scenes::writePng(b.string(), words, heights.data()));
  CHECK(pixelsOf<std::uint16_t>(b, words) == heights);
  CHECK(errors.text().empty());
}

TEST_CASE("write png: what cannot be written is told on stderr, by the file's name", "[scenes]") {
  const Scratch scratch;
  const std::uint8_t grey = 128;
  for (const char* name : {"none/a.png", "a.nothing"}) {
    const std::string file = (scratch.path / name).string();
    const HeardErrors errors;
    CHECK_FALSE(scenes::writePng(file, ImageSpec(1, 1, 1, TypeDesc::UINT8), &grey));
    CHECK_THAT(errors.text(), Catch::StartsWith(file + ": cannot be written: "));
    CHECK(errors.text().size() > file.size() + std::string(": cannot be written: \n").size());
  }
}

TEST_CASE("write png: a picture that the disk does not take to its last byte is a failure", "[scenes]") {
  const Scratch scratch;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 40 * 30 * 3; ++i) pixels.push_back(std::uint8_t(i * 7919 % 251));
  const ImageSpec spec(40, 30, 3, TypeDesc::UINT8);
  const std::string whole = (scratch.path / "whole.png").string();
  REQUIRE(scenes::writePng(whole, spec, pixels.data()));
  const auto size = std::filesystem::file_size(whole);
  for (const std::uintmax_t limit : {std::uintmax_t{1}, size / 2, size - 1}) {
    CAPTURE(limit, size);
    const HeardErrors errors;
    bool taken = true;
    {
      const FileLimit less(limit);
      taken = scenes::writePng((scratch.path / "cut.png").string(), spec, pixels.data());
    }
    CHECK_FALSE(taken);
    CHECK_THAT(errors.text(), Contains("cut.png: cannot be written: "));
  }
}
