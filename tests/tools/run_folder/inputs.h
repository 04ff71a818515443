// Files that runs begin with, and words for the command line.
#pragma once

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// Grey waves of 8 bits; another `phase`, another picture of the same size.
inline void writeImage(const std::filesystem::path& file, int size, int channels, double phase = 0.0) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < channels; ++c)
        pixels.push_back(
            std::uint8_t(std::lround(127.5 + 100.0 * std::sin(0.2 * x + phase + c) * std::cos(0.3 * y))));
  const auto out = OIIO::ImageOutput::create(file.string());
  REQUIRE(out);
  REQUIRE(out->open(file.string(), OIIO::ImageSpec(size, size, channels, OIIO::TypeDesc::UINT8)));
  REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
  REQUIRE(out->close());
}
