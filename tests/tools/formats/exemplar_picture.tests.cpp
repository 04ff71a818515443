#include "tools/formats/exemplar_picture.h"

#include "tests/scratch.h"
#include "texture/exemplar/read_image.h"
#include "texture/exemplar/srgb.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;

TEST_CASE("exemplar picture: eight bits of sRGB come back as they were, alpha only where there is some",
          "[tools]") {
  const Scratch scratch;
  for (const bool seeThrough : {false, true}) {
    texture::Image image{16, 16, 4, {}};
    for (int i = 0; i < 256; ++i)
      for (int c = 0; c < 4; ++c)
        image.data.push_back(c < 3        ? texture::decodeSrgb(float((i + 5 * c) % 256) / 255.0f)
                             : seeThrough ? float(i) / 255.0f
                                          : 1.0f);
    const std::string bytes = tools::pngOf(image);
    CHECK(tools::isSeeThrough(image) == seeThrough);
    CHECK(int(bytes[25]) == (seeThrough ? 6 : 2));  // the colour type of its header
    const std::filesystem::path file = scratch.path / "a.png";
    std::ofstream(file, std::ios::binary) << bytes;
    const texture::Image read = texture::readImage(file);
    REQUIRE(read.data.size() == image.data.size());
    for (std::size_t i = 0; i < read.data.size(); ++i)
      CHECK(std::abs(texture::encodeSrgb(read.data[i]) - texture::encodeSrgb(image.data[i])) < 0.5f / 255.0f);
  }
}

TEST_CASE("exemplar picture: numbers come back as they are, to sixteen bits", "[tools]") {
  const Scratch scratch;
  for (const int channels : {1, 3}) {
    texture::Image map{32, 8, channels, {}};
    for (int i = 0; i < 32 * 8 * channels; ++i) map.data.push_back(float(i) / float(32 * 8 * channels - 1));
    const std::filesystem::path file = scratch.path / "map.png";
    std::ofstream(file, std::ios::binary) << tools::pngOfNumbers(map);
    const texture::Image read = texture::readMap(file);
    REQUIRE(read.channels == channels);
    REQUIRE(read.data.size() == map.data.size());
    for (std::size_t i = 0; i < read.data.size(); ++i)
      CHECK(read.data[i] == Approx(map.data[i]).margin(0.6 / 65535.0));
  }
}
