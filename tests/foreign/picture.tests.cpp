#include "foreign/picture.h"

#include "tests/foreign/picture_files.h"
#include "tests/scratch.h"

#include <webp/mux.h>

#include <catch2/catch.hpp>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i));
  return text;
}

// 5 x 1 pixels of four bytes: blue, green, red and `fourth`.
std::string rows32(char fourth) {
  std::string text;
  for (int x = 0; x < 5; ++x) text += {char(10 * x), char(100), char(200), fourth};
  return text;
}

std::string bitmap(char fourth, bool saysAlpha) {
  std::string header = little(saysAlpha ? 108 : 40, 4) + little(5, 4) + little(1, 4) + little(1, 2) +
                       little(32, 2) + little(saysAlpha ? 3 : 0, 4) + std::string(20, '\0');
  if (saysAlpha)
    header += little(0xff0000, 4) + little(0xff00, 4) + little(0xff, 4) + little(0xff000000, 4) +
              std::string(52, '\0');
  const std::uint32_t start = std::uint32_t(14 + header.size());
  return "BM" + little(start + 20, 4) + little(0, 4) + little(start, 4) + header + rows32(fourth);
}

std::string targa(char fourth, bool saysAlpha) {
  return std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + little(5, 2) + little(1, 2) + char(32) +
         char(0x20 | (saysAlpha ? 8 : 0)) + rows32(fourth);
}

}  // namespace

TEST_CASE("picture: what is stored comes as it is stored", "[foreign]") {
  const Scratch scratch;
  const Picture byte = readColors(write(scratch, "a.png", rgb()));
  CHECK(byte.sample == Sample::byte);
  CHECK(byte.curve == Curve::srgb);
  checkShows(byte, 0, 0, kWidth, kHeight, 0);
  const Picture word = readColors(write(scratch, "b.png", rgb(TypeDesc::UINT16, 4)));
  CHECK(word.sample == Sample::word);
  CHECK(word.channels == 4);
  checkShows(word, 0, 0, kWidth, kHeight, 0);
  const Picture real = readColors(write(scratch, "c.exr", rgb(TypeDesc::HALF)));
  CHECK(real.sample == Sample::real);
  CHECK(real.curve == Curve::linear);
  checkShows(real, 0, 0, kWidth, kHeight, 0);
}

TEST_CASE("picture: an EXR's layer and part are taken by their names", "[foreign]") {
  const Scratch scratch;
  ImageSpec layers = rgb(TypeDesc::HALF, 6);
  layers.channelnames = {"albedo.R", "albedo.G", "albedo.B", "rgba.R", "rgba.G", "rgba.B"};
  checkShows(readColors(write(scratch, "layers.exr", layers)), 0, 0, kWidth, kHeight, 3);
  layers.channelnames = {"albedo.R", "albedo.G", "albedo.B", "normal.R", "normal.G", "normal.B"};
  CHECK_THROWS_WITH(readColors(write(scratch, "none.exr", layers)), Contains("albedo, normal"));

  const std::string file = (scratch.path / "parts.exr").string();
  ImageSpec parts[2] = {rgb(TypeDesc::HALF, 1), rgb(TypeDesc::HALF)};
  parts[0].channelnames = {"Z"};
  parts[0].attribute("oiio:subimagename", "depth");
  parts[1].attribute("oiio:subimagename", "rgba");
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output->open(file, 2, parts));
  REQUIRE(output->write_image(TypeDesc::FLOAT, pixels(parts[0]).data()));
  REQUIRE(output->open(file, parts[1], OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(TypeDesc::FLOAT, pixels(parts[1]).data()));
  REQUIRE(output->close());
  const Picture beauty = readColors(file);
  CHECK(beauty.channels == 3);
  checkShows(beauty, 0, 0, kWidth, kHeight, 0);
}

TEST_CASE("picture: of an EXR what lies inside its display window", "[foreign]") {
  const Scratch scratch;
  ImageSpec over = rgb(TypeDesc::HALF);
  over.full_x = 4;
  over.full_y = 2;
  over.full_width = 10;
  over.full_height = 12;
  checkShows(readColors(write(scratch, "over.exr", over)), 4, 2, 10, 12, 0);
  // What is not stored is not made up.
  ImageSpec part = rgb(TypeDesc::HALF);
  part.x = 5;
  part.full_width = 100;
  part.full_height = 100;
  checkShows(readColors(write(scratch, "part.exr", part)), 0, 0, kWidth, kHeight, 0);
  ImageSpec beside = rgb(TypeDesc::HALF);
  beside.full_x = 1000;
  beside.full_width = 10;
  beside.full_height = 10;
  CHECK_THROWS_WITH(readColors(write(scratch, "beside.exr", beside)), Contains("display window"));
}

TEST_CASE("picture: the orientation that a WebP file says", "[foreign]") {
  const Scratch scratch;
  const auto plain = write(scratch, "plain.webp", rgb());
  CHECK(readColors(plain).orientation == 1);
  const std::string bytes = readBytes(plain);
  const WebPData whole{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  WebPMux* mux = WebPMuxCreate(&whole, 1);
  REQUIRE(mux);
  // A directory of one entry: 0x0112, a short, 6.
  const std::string exif("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 26);
  for (const std::string& text : {exif, std::string("Exif\0\0", 6) + exif}) {
    const WebPData chunk{reinterpret_cast<const uint8_t*>(text.data()), text.size()};
    REQUIRE(WebPMuxSetChunk(mux, "EXIF", &chunk, 1) == WEBP_MUX_OK);
    WebPData made;
    REQUIRE(WebPMuxAssemble(mux, &made) == WEBP_MUX_OK);
    writeBytes(scratch.path / "turned.webp", {reinterpret_cast<const char*>(made.bytes), made.size});
    WebPDataClear(&made);
    CHECK(readColors(scratch.path / "turned.webp").orientation == 6);
  }
  WebPMuxDelete(mux);
}

TEST_CASE("picture: bytes that pad a pixel are no alpha, unless the file says so", "[foreign]") {
  const Scratch scratch;
  const auto shown = [&](const char* name, const std::string& bytes) {
    writeBytes(scratch.path / name, bytes);
    return readColors(scratch.path / name);
  };
  for (const Picture& padded : {shown("pad.bmp", bitmap(0, false)), shown("pad.tga", targa(0, false))}) {
    CHECK(padded.channels == 3);
    CHECK_THAT(pixel(padded, 4, 0)[0], WithinAbs(200.0 / 255.0, 1e-4));
    CHECK_THAT(pixel(padded, 4, 0)[2], WithinAbs(40.0 / 255.0, 1e-4));
  }
  for (const Picture& clear : {shown("clear.bmp", bitmap(0, true)), shown("clear.tga", targa(0, true))}) {
    REQUIRE(clear.channels == 4);
    CHECK(pixel(clear, 4, 0)[3] == 0.0f);
  }
  for (const Picture& veiled :
       {shown("half.bmp", bitmap(100, false)), shown("half.tga", targa(100, false)),
        shown("half2.bmp", bitmap(100, true)), shown("half2.tga", targa(100, true))}) {
    REQUIRE(veiled.channels == 4);
    CHECK(veiled.straight != 0);
    CHECK_THAT(pixel(veiled, 4, 0)[0], WithinAbs(200.0 / 255.0, 1e-4));
  }
}
