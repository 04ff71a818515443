// Heights: the first channel of a picture of any kind as the library that reads it gives it, bit for bit.
#include "foreign/picture.h"
#include "tests/scratch.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

// All of the 65536 words once; of bytes each 256 times. Further channels hold something else.
std::filesystem::path write(const Scratch& scratch, const std::string& name, TypeDesc type, int channels) {
  const std::string file = (scratch.path / name).string();
  const auto output = OIIO::ImageOutput::create(file);
  ImageSpec spec(256, 256, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  std::vector<float> data;
  for (int i = 0; i < 65536; ++i)
    for (int c = 0; c < channels; ++c) data.push_back(float((i + 20000 * c) % 65536) / 65535.0f);
  REQUIRE(output);
  REQUIRE(output->open(file, spec));
  REQUIRE(output->write_image(TypeDesc::FLOAT, data.data()));
  REQUIRE(output->close());
  return file;
}

// What the library itself makes of the first channel.
std::vector<float> floatsOf(const std::filesystem::path& file) {
  ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &hints);
  REQUIRE(input);
  std::vector<float> values(std::size_t(input->spec().width) * std::size_t(input->spec().height));
  REQUIRE(input->read_image(0, 0, 0, 1, TypeDesc::FLOAT, values.data()));
  return values;
}

std::vector<float> sharesOf(const Picture& heights) {
  REQUIRE(heights.channels == 1);
  std::vector<float> values;
  for (std::size_t at = 0; at < heights.samples.size(); at += heights.sampleSize())
    values.push_back(shareAt(&heights.samples[at], heights.sample));
  return values;
}

}  // namespace

TEST_CASE("heights: of every kind of file, as its library gives them, with their white", "[foreign]") {
  const Scratch scratch;
  const double byte = 255.0, word = 65535.0;
  const std::tuple<const char*, TypeDesc, int, double> files[] = {
      {"a.sgi", TypeDesc::UINT8, 1, byte},    {"b.sgi", TypeDesc::UINT16, 1, word},
      {"c.sgi", TypeDesc::UINT16, 4, word},   {"a.dpx", TypeDesc::UINT8, 3, byte},
      {"b.dpx", TypeDesc::UINT16, 3, word},   {"a.gif", TypeDesc::UINT8, 3, byte},
      {"a.png", TypeDesc::UINT8, 1, byte},    {"b.png", TypeDesc::UINT16, 1, word},
      {"c.png", TypeDesc::UINT16, 4, word},   {"d.png", TypeDesc::UINT8, 2, byte},
      {"a.pgm", TypeDesc::UINT8, 1, byte},    {"a.bmp", TypeDesc::UINT8, 3, byte},
      {"a.tga", TypeDesc::UINT8, 4, byte},    {"a.jpg", TypeDesc::UINT8, 1, byte},
      {"a.exr", TypeDesc::HALF, 4, 1.0},      {"b.exr", TypeDesc::FLOAT, 1, 1.0},
      {"a.hdr", TypeDesc::FLOAT, 3, 1.0},     {"a.tif", TypeDesc::UINT8, 2, byte},
      {"b.tif", TypeDesc::UINT16, 1, word},   {"c.tif", TypeDesc::UINT32, 1, 4294967295.0},
      {"d.tif", TypeDesc::INT16, 1, 32767.0}, {"e.tif", TypeDesc::INT32, 1, 2147483647.0},
      {"f.tif", TypeDesc::FLOAT, 1, 1.0},     {"g.tif", TypeDesc::DOUBLE, 1, 1.0},
      {"h.tif", TypeDesc::INT8, 1, 127.0}};
  for (const auto& [name, type, channels, white] : files) {
    INFO(name);
    const auto file = write(scratch, name, type, channels);
    const Picture heights = readHeights(file);
    CHECK(heights.white == white);
    CHECK(heights.hasNoData == 0);
    CHECK(sharesOf(heights) == floatsOf(file));
  }
}

TEST_CASE("heights: more pixels than a picture of colours may have, but none longer than a side may be",
          "[foreign]") {
  const Scratch scratch;
  const auto says = [&](const char* size) {
    std::ofstream(scratch.path / "says.pgm", std::ios::binary) << "P5\n" << size << "\n255\n";
    return scratch.path / "says.pgm";
  };
  CHECK_THROWS_WITH(readHeights(says("16385 4")), Contains("16385 x 4 pixels, and at most 16384 a side"));
  CHECK_THROWS_WITH(readHeights(says("16384 16384")), Contains("damaged or cut short"));
  CHECK_THROWS_WITH(readColors(says("16384 16384")), Contains("too large"));
}
