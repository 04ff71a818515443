// Pictures that the tests write, and what is read of them.
#pragma once

#include "foreign/picture.h"
#include "tests/scratch.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::foreign {

constexpr int kWidth = 24, kHeight = 16;

// Different at every place and in every channel.
inline float stored(int x, int y, int channel) {
  return float((x * 7 + y * 11 + channel * 50) % 220 + 20) / 255.0f;
}

inline std::vector<float> pixels(const OIIO::ImageSpec& spec) {
  std::vector<float> data;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      for (int c = 0; c < spec.nchannels; ++c) data.push_back(stored(x, y, c));
  return data;
}

inline std::filesystem::path write(const Scratch& scratch, const std::string& name,
                                   const OIIO::ImageSpec& spec) {
  const std::string file = (scratch.path / name).string();
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output->open(file, spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, pixels(spec).data()));
  REQUIRE(output->close());
  return file;
}

inline OIIO::ImageSpec rgb(OIIO::TypeDesc type = OIIO::TypeDesc::UINT8, int channels = 3) {
  OIIO::ImageSpec spec(kWidth, kHeight, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // written as it is
  return spec;
}

// As floats 0..1.
inline std::vector<float> pixel(const Picture& picture, int x, int y) {
  std::vector<float> values;
  const std::size_t size = picture.sampleSize();
  const char* at = picture.samples.data() + (std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) *
                                                std::size_t(picture.channels) * size;
  for (int c = 0; c < picture.channels; ++c, at += size) {
    if (picture.sample == Sample::byte) values.push_back(float(static_cast<unsigned char>(*at)) / 255.0f);
    std::uint16_t word = 0;
    if (picture.sample == Sample::word)
      std::memcpy(&word, at, size), values.push_back(float(word) / 65535.0f);
    float real = 0.0f;
    if (picture.sample == Sample::real) std::memcpy(&real, at, size), values.push_back(real);
  }
  return values;
}

// The picture's channels are these of what was written, from this corner on.
inline void checkShows(const Picture& picture, int left, int top, int width, int height, int firstChannel) {
  REQUIRE(picture.width == width);
  REQUIRE(picture.height == height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::vector<float> values = pixel(picture, x, y);
      for (int c = 0; c < picture.channels; ++c)
        if (std::abs(values[std::size_t(c)] - stored(left + x, top + y, firstChannel + c)) > 2e-3f)
          FAIL(x << " " << y << " " << c << ": " << values[std::size_t(c)]);
    }
}

}  // namespace fluidtex::foreign
