// A picture of two halves, each of one colour.
#pragma once

#include "render/render.h"

#include <array>
#include <filesystem>

namespace fluidtex {

// Colours are linear, 0 to 1. Returns the file.
inline std::filesystem::path writeHalves(const std::filesystem::path& file, int width, int height,
                                         const std::array<float, 3>& left,
                                         const std::array<float, 3>& right) {
  render::Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const float channel : 2 * x < width ? left : right) picture.rgb.push_back(channel);
  render::writePng(picture, file);
  return file;
}

}  // namespace fluidtex
