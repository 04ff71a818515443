// Leaves that float on water: what is between them is cut out.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Leaves {
  int size = 512;   // pixels, width and height
  int across = 22;  // places for a leaf, across
  int samples = 3;  // a pixel's side, for anti-aliasing
  std::uint64_t seed = 41;
};

// Autumn leaves with ribs and veins, turned any way, some over others; alpha 0 between them. Toroidal.
// size x size x 4, sRGB, straight alpha, rows from the top.
std::vector<std::uint8_t> makeLeaves(const Leaves& options = {});

}  // namespace fluidtex::exemplars
