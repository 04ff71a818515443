// Paint laid on with a brush.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Strokes {
  int size = 512;   // pixels, width and height
  int across = 19;  // places for a stroke, across, in each coat of paint
  int coats = 3;
  int samples = 3;  // a pixel's side, for anti-aliasing
  std::uint64_t seed = 19;
};

// Strokes along the rows, blue and green with some white and ochre, each with the marks of its bristles.
// Toroidal. size x size x 3, sRGB, rows from the top.
std::vector<std::uint8_t> makeStrokes(const Strokes& options = {});

}  // namespace fluidtex::exemplars
