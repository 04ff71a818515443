// Water seen from above, with more or less foam on it.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct FoamyWater {
  int size = 384;   // pixels, width and height
  int holes = 18;   // holes in the foam, across
  int samples = 3;  // a pixel's side, for anti-aliasing
  std::uint64_t seed = 23;
};

// All amounts of foam side by side: open water with a few threads, nets whose holes close, white froth; and a
// map that tells them apart. Toroidal.
struct FoamImages {
  std::vector<std::uint8_t> pixels;  // size x size x 3, sRGB, rows from the top
  std::vector<std::uint8_t>
      guidance;  // size x size: 0 water, 255 froth, each level about as often as the others
};
FoamImages makeFoam(const FoamyWater& options = {});

}  // namespace fluidtex::exemplars
