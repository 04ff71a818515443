#include "texture/exemplar/read_image.h"

#include "texture/exemplar/srgb.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

using namespace fluidtex::texture;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinAbs;
using OIIO::TypeDesc;

namespace {

// A folder of its own for a test's files.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fluidtex_images_" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

constexpr int kWidth = 43, kHeight = 37;

// Different in every pixel and channel.
float stored(int x, int y, int channel) {
  return float((x * 5 + y * 3 + channel * 40) % 200 + 30) / 255.0f;
}

std::filesystem::path write(const Folder& folder, const std::string& name, int channels, TypeDesc type,
                            const char* key = nullptr, int value = 0) {
  const std::filesystem::path file = folder.path / name;
  OIIO::ImageSpec spec(kWidth, kHeight, channels, type);
  if (channels == 2) spec.channelnames = {"Y", "A"}, spec.alpha_channel = 1;
  // Values are written as they are: alpha is not to be multiplied in.
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (key) spec.attribute(key, value);
  std::vector<float> data;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < channels; ++c) data.push_back(stored(x, y, c));
  const auto output = OIIO::ImageOutput::create(file.string());
  REQUIRE(output);
  REQUIRE(output->open(file.string(), spec));
  REQUIRE(output->write_image(TypeDesc::FLOAT, data.data()));
  REQUIRE(output->close());
  return file;
}

// The image is what write() has stored, with these channels as red, green, blue and alpha (-1: one).
void checkPixels(const Image& image, std::array<int, 4> order, bool encoded, double tolerance) {
  REQUIRE(image.width == kWidth);
  REQUIRE(image.height == kHeight);
  REQUIRE(image.channels == 4);
  double worst = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 4; ++c) {
        const float value = image.at(x, y)[c];
        const float expected = order[std::size_t(c)] < 0 ? 1.0f : stored(x, y, order[std::size_t(c)]);
        worst = std::max(worst, double(std::abs((encoded && c < 3 ? encodeSrgb(value) : value) - expected)));
      }
  CHECK(worst < tolerance);
}

void writeBytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

// The refusal: it must be one sentence that begins with the file's name.
std::string refusal(const std::filesystem::path& file, const SynthesisOptions& options = {}) {
  std::string message;
  try {
    loadExemplar({.file = file}, options, 3);
  } catch (const ExemplarError& error) {
    message = error.what();
  }
  CHECK_THAT(message, StartsWith(file.string()) && EndsWith("."));
  CHECK(message.find('\n') == std::string::npos);
  CHECK(message.find(". ") == std::string::npos);
  return message;
}

}  // namespace

TEST_CASE("image: whole numbers are sRGB, in 8 and 16 bits, with and without alpha", "[texture]") {
  const Folder folder;
  for (const bool deep : {false, true})
    for (const std::string format : {".png", ".tif"}) {
      INFO(format << (deep ? " 16 bits" : " 8 bits"));
      const TypeDesc type = deep ? TypeDesc::UINT16 : TypeDesc::UINT8;
      const double tolerance = deep ? 1e-4 : 0.6 / 255.0;
      checkPixels(readImage(write(folder, "grey" + format, 1, type)), {0, 0, 0, -1}, true, tolerance);
      checkPixels(readImage(write(folder, "greya" + format, 2, type)), {0, 0, 0, 1}, true, tolerance);
      checkPixels(readImage(write(folder, "rgb" + format, 3, type)), {0, 1, 2, -1}, true, tolerance);
      checkPixels(readImage(write(folder, "rgba" + format, 4, type)), {0, 1, 2, 3}, true, tolerance);
    }
  checkPixels(readImage(write(folder, "rgb.bmp", 3, TypeDesc::UINT8)), {0, 1, 2, -1}, true, 0.6 / 255.0);
  checkPixels(readImage(write(folder, "rgba.tga", 4, TypeDesc::UINT8)), {0, 1, 2, 3}, true, 0.6 / 255.0);
}

TEST_CASE("image: floats are linear", "[texture]") {
  const Folder folder;
  checkPixels(readImage(write(folder, "rgb.exr", 3, TypeDesc::FLOAT)), {0, 1, 2, -1}, false, 1e-6);
  checkPixels(readImage(write(folder, "half.exr", 3, TypeDesc::HALF)), {0, 1, 2, -1}, false, 1e-3);
  checkPixels(readImage(write(folder, "grey.exr", 1, TypeDesc::FLOAT)), {0, 0, 0, -1}, false, 1e-6);
  checkPixels(readImage(write(folder, "rgb.tif", 3, TypeDesc::FLOAT)), {0, 1, 2, -1}, false, 1e-6);
}

TEST_CASE("image: multiplied alpha of a float file is divided out", "[texture]") {
  const Folder folder;
  const Image image = readImage(write(folder, "rgba.exr", 4, TypeDesc::FLOAT));
  for (int c = 0; c < 3; ++c)
    CHECK_THAT(image.at(7, 5)[c], WithinAbs(stored(7, 5, c) / stored(7, 5, 3), 1e-5));
  CHECK_THAT(image.at(7, 5)[3], WithinAbs(stored(7, 5, 3), 1e-6));
}

TEST_CASE("image: a photograph's orientation is applied", "[texture]") {
  const Folder folder;
  // Stored row 0 is the right side, stored column 0 the top (6), and the other way round (8); upside down
  // (3); mirrored (2).
  const auto shown = [&](int orientation) {
    return readImage(write(folder, "turned.tif", 3, TypeDesc::UINT8, "Orientation", orientation));
  };
  const auto same = [](const float* pixel, int x, int y) {
    for (int c = 0; c < 3; ++c)
      if (std::abs(encodeSrgb(pixel[c]) - stored(x, y, c)) > 0.6f / 255.0f) return false;
    return true;
  };
  for (int orientation = 1; orientation <= 8; ++orientation) {
    INFO(orientation);
    const Image image = shown(orientation);
    REQUIRE(image.width == (orientation > 4 ? kHeight : kWidth));
    REQUIRE(image.height == (orientation > 4 ? kWidth : kHeight));
    // Where the stored picture's first pixel has gone, and the one right of it.
    const int right = image.width - 1, bottom = image.height - 1;
    const int first[9][4] = {{},
                             {0, 0, 1, 0},
                             {right, 0, right - 1, 0},
                             {right, bottom, right - 1, bottom},
                             {0, bottom, 1, bottom},
                             {0, 0, 0, 1},
                             {right, 0, right, 1},
                             {right, bottom, right, bottom - 1},
                             {0, bottom, 0, bottom - 1}};
    const int* at = first[orientation];
    CHECK(same(image.at(at[0], at[1]), 0, 0));
    CHECK(same(image.at(at[2], at[3]), 1, 0));
  }
}

TEST_CASE("image: a palette is looked up", "[texture]") {
  const Folder folder;
  // A bitmap of 4 x 1 pixels, 8 bits each, with two colours: blue, green, red, nothing.
  std::vector<unsigned char> bytes = {'B', 'M', 66, 0, 0,   0,   0, 0,  0, 0, 62, 0, 0, 0, 40, 0, 0,
                                      0,   4,   0,  0, 0,   1,   0, 0,  0, 1, 0,  8, 0, 0, 0,  0, 0,
                                      4,   0,   0,  0, 0,   0,   0, 0,  0, 0, 0,  0, 2, 0, 0,  0, 0,
                                      0,   0,   0,  0, 128, 255, 0, 64, 0, 0, 0,  0, 1, 1, 0};
  writeBytes(folder.path / "palette.bmp", bytes);
  const Image image = readImage(folder.path / "palette.bmp");
  REQUIRE(image.width == 4);
  REQUIRE(image.height == 1);
  CHECK_THAT(encodeSrgb(image.at(0, 0)[0]), WithinAbs(1.0, 1e-5));
  CHECK_THAT(encodeSrgb(image.at(0, 0)[1]), WithinAbs(128.0 / 255.0, 1e-5));
  CHECK_THAT(encodeSrgb(image.at(2, 0)[2]), WithinAbs(64.0 / 255.0, 1e-5));
  CHECK(image.at(3, 0)[3] == 1.0f);
}

TEST_CASE("image: inks are turned into light", "[texture]") {
  const Folder folder;
  // 8 x 8 pixels of a CMYK photograph: full cyan in the left half, half black in the right.
  const std::vector<unsigned char> bytes = {
      0xff, 0xd8, 0xff, 0xee, 0x00, 0x0e, 0x41, 0x64, 0x6f, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00,
      0x00, 0xff, 0xdb, 0x00, 0x43, 0x00, 0x03, 0x02, 0x02, 0x03, 0x02, 0x02, 0x03, 0x03, 0x03, 0x03, 0x04,
      0x03, 0x03, 0x04, 0x05, 0x08, 0x05, 0x05, 0x04, 0x04, 0x05, 0x0a, 0x07, 0x07, 0x06, 0x08, 0x0c, 0x0a,
      0x0c, 0x0c, 0x0b, 0x0a, 0x0b, 0x0b, 0x0d, 0x0e, 0x12, 0x10, 0x0d, 0x0e, 0x11, 0x0e, 0x0b, 0x0b, 0x10,
      0x16, 0x10, 0x11, 0x13, 0x14, 0x15, 0x15, 0x15, 0x0c, 0x0f, 0x17, 0x18, 0x16, 0x14, 0x18, 0x12, 0x14,
      0x15, 0x14, 0xff, 0xc0, 0x00, 0x14, 0x08, 0x00, 0x08, 0x00, 0x08, 0x04, 0x43, 0x11, 0x00, 0x4d, 0x11,
      0x00, 0x59, 0x11, 0x00, 0x4b, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x16, 0x00, 0x01, 0x01, 0x01, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x09, 0x01, 0x08, 0xff, 0xc4, 0x00,
      0x1b, 0x10, 0x00, 0x01, 0x04, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x00, 0x08, 0x09, 0x46, 0xc4, 0x47, 0x84, 0x85, 0xff, 0xda, 0x00, 0x0e, 0x04, 0x43, 0x00, 0x4d,
      0x00, 0x59, 0x00, 0x4b, 0x00, 0x00, 0x3f, 0x00, 0x8c, 0x63, 0x9b, 0x38, 0x97, 0xc5, 0x4c, 0x54, 0xcd,
      0x50, 0xba, 0x21, 0x3b, 0xd5, 0xcf, 0xff, 0xd9};
  writeBytes(folder.path / "inks.jpg", bytes);
  const Image image = readImage(folder.path / "inks.jpg");
  REQUIRE(image.width == 8);
  const float cyan[3] = {0.0f, 1.0f, 1.0f};
  for (int c = 0; c < 3; ++c) {
    CHECK_THAT(encodeSrgb(image.at(1, 4)[c]), WithinAbs(cyan[c], 0.02));
    CHECK_THAT(encodeSrgb(image.at(6, 4)[c]), WithinAbs(127.0 / 255.0, 0.02));
  }
}

TEST_CASE("image: what cannot be read is refused in one sentence that names the file", "[texture]") {
  const Folder folder;
  CHECK_THAT(refusal(folder.path / "nothing.png"), Contains("does not exist"));
  CHECK_THAT(refusal(folder.path), Contains("folder"));
  writeBytes(folder.path / "words.png", {'h', 'e', 'l', 'l', 'o', '\n'});
  CHECK_THAT(refusal(folder.path / "words.png"), Contains("cannot be read as an image"));
  writeBytes(folder.path / "words.txt", {'h', 'e', 'l', 'l', 'o', '\n'});
  CHECK_THAT(refusal(folder.path / "words.txt"), Contains("cannot be read as an image"));
  writeBytes(folder.path / "empty.png", {});
  CHECK_THAT(refusal(folder.path / "empty.png"), Contains("cannot be read as an image"));

  const auto whole = write(folder, "whole.tif", 3, TypeDesc::UINT8);
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  refusal(whole);
}

TEST_CASE("image: what can be read but not used is refused likewise", "[texture]") {
  const Folder folder;
  const auto make = [&](const std::string& name, int width, int height, int channels, float value,
                        TypeDesc type) {
    const std::string file = (folder.path / name).string();
    const std::vector<float> data(std::size_t(width) * std::size_t(height) * std::size_t(channels), value);
    const auto output = OIIO::ImageOutput::create(file);
    REQUIRE(output->open(file, OIIO::ImageSpec(width, height, channels, type)));
    REQUIRE(output->write_image(TypeDesc::FLOAT, data.data()));
    REQUIRE(output->close());
    return folder.path / name;
  };
  CHECK_THAT(refusal(make("small.png", 32, 90, 3, 0.5f, TypeDesc::UINT8)),
             Contains("too small") && Contains("32 x 90"));
  CHECK_THAT(refusal(make("clear.png", 64, 64, 4, 0.0f, TypeDesc::UINT8)), Contains("transparent"));
  CHECK_THAT(refusal(make("wide.png", kLargestSide + 1, 40, 1, 0.5f, TypeDesc::UINT8)),
             Contains("too large"));
  CHECK_THAT(refusal(make("none.exr", 64, 64, 3, std::numeric_limits<float>::quiet_NaN(), TypeDesc::FLOAT)),
             Contains("not finite"));
  CHECK_THAT(refusal(make("endless.exr", 64, 64, 3, std::numeric_limits<float>::infinity(), TypeDesc::FLOAT)),
             Contains("not finite"));
}

TEST_CASE("exemplar: a file gives what its pixels give", "[texture]") {
  const Folder folder;
  const auto file = write(folder, "rgba.png", 4, TypeDesc::UINT8);
  const Exemplar loaded = loadExemplar({.file = file, .toroidal = true}, {}, 3),
                 made = makeExemplar(readImage(file), true, {}, 3);
  CHECK(loaded.toroidal);
  CHECK(loaded.colorChannels == 4);
  CHECK(loaded.color.data == made.color.data);
  REQUIRE(loaded.match.size() == made.match.size());
  for (std::size_t level = 0; level < loaded.match.size(); ++level)
    CHECK(loaded.match[level].data == made.match[level].data);
}

TEST_CASE("read image: a map's numbers are those that are stored, of one channel or three", "[texture]") {
  const Folder folder;
  const auto check = [](const Image& map, int channels) {
    REQUIRE(map.width == kWidth);
    REQUIRE(map.height == kHeight);
    REQUIRE(map.channels == channels);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < channels; ++c) CHECK(map.at(x, y)[c] == Approx(stored(x, y, c)).margin(1e-6));
  };
  check(readMap(write(folder, "grey.png", 1, TypeDesc::UINT8)), 1);
  check(readMap(write(folder, "rgb.png", 3, TypeDesc::UINT8)), 3);
  check(readMap(write(folder, "first.png", 3, TypeDesc::UINT8), 1), 1);
  check(readMap(write(folder, "float.exr", 1, TypeDesc::FLOAT)), 1);
  CHECK_THROWS_WITH(readMap(folder.path / "none.png"), Contains("none.png does not exist"));
}

TEST_CASE("exemplar: its maps are read with it, a guidance map of another size is refused", "[texture]") {
  const Folder folder;
  ExemplarOptions options;
  options.file = write(folder, "rgb.png", 3, TypeDesc::UINT8);
  options.guidance = write(folder, "map.png", 1, TypeDesc::UINT8);
  options.maps = {{"height", options.guidance}};
  SynthesisOptions synthesis;
  synthesis.windows = {9};
  synthesis.guidanceWeight = 4.0;
  const Exemplar exemplar = loadExemplar(options, synthesis, 2);
  CHECK(exemplar.guided);
  REQUIRE(exemplar.match[0].channels == 3 + 1 + 2);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      CHECK(exemplar.match[0].at(x, y)[3] == Approx(2.0f * stored(x, y, 0)).margin(1e-5));
  REQUIRE(exemplar.maps.contains("height"));
  CHECK(exemplar.maps.at("height").image.channels == 1);

  const std::filesystem::path other = folder.path / "other.png";
  const auto output = OIIO::ImageOutput::create(other.string());
  REQUIRE(output->open(other.string(), OIIO::ImageSpec(20, 30, 1, TypeDesc::UINT8)));
  REQUIRE(output->write_image(TypeDesc::FLOAT, std::vector<float>(600, 0.5f).data()));
  REQUIRE(output->close());
  options.guidance = other;
  CHECK_THROWS_WITH(loadExemplar(options, synthesis, 2),
                    Contains("other.png has 20 x 30 pixels, and its exemplar") && Contains("43 x 37"));
}
