// Pictures that ship, and how they go on over their edges.
#pragma once

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace fluidtex::exemplars {

using Pixels = std::vector<std::uint8_t>;

// Mean absolute difference between each pixel of line a and its neighbour in line b; lines are columns or
// rows.
inline double step(const Pixels& pixels, int size, int a, int b, bool columns, int channels = 3) {
  double sum = 0.0;
  for (int i = 0; i < size; ++i) {
    for (int channel = 0; channel < channels; ++channel) {
      const auto at = [&](int line) {
        const int x = columns ? line : i, y = columns ? i : line;
        return int(pixels[std::size_t((y * size + x) * channels + channel)]);
      };
      sum += std::abs(at(a) - at(b));
    }
  }
  return sum / (double(size) * channels);
}

// Whether the picture goes on over its edges: no step there is larger than the largest inside.
inline bool isToroidal(const Pixels& pixels, int size, int channels = 3) {
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < size; ++i)
      largest = std::max(largest, step(pixels, size, i, i + 1, columns, channels));
    if (step(pixels, size, size - 1, 0, columns, channels) > largest) return false;
  }
  return true;
}

// The pixels of a square image that ships.
inline Pixels shipped(const std::string& name, int size, int channels = 3) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(FLUIDTEX_SOURCE_DIR "/scenes/exemplars/" + name, &config);
  REQUIRE(input);
  REQUIRE(input->spec().width == size);
  REQUIRE(input->spec().height == size);
  REQUIRE(input->spec().nchannels == channels);
  Pixels pixels(std::size_t(size) * size * channels);
  REQUIRE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data()));
  return pixels;
}

}  // namespace fluidtex::exemplars
