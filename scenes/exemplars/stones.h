// Stones that float beside each other, water between them.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Stones {
  int size = 512;   // pixels, width and height
  int across = 20;  // stones, across
  int samples = 3;  // a pixel's side, for anti-aliasing
  std::uint64_t seed = 7;
};

// Worn stones of all greys and browns with veins and pits; alpha 0 between them. Toroidal.
struct StoneImages {
  std::vector<std::uint8_t> pixels;  // size x size x 4, sRGB, straight alpha, rows from the top
  std::vector<std::uint8_t> height;  // size x size: 0 the water, 255 the highest stone
};
StoneImages makeStones(const Stones& options = {});

}  // namespace fluidtex::exemplars
