// Small waves on water, as the wind makes them.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Waves {
  int size = 512;      // pixels, width and height
  int waves = 90;      // plane waves
  double steep = 0.2;  // root mean square of the slope
  std::uint64_t seed = 3;
};

// Waves whose crests lie along the rows, more or less. Toroidal.
struct WaveImages {
  std::vector<std::uint8_t> pixels;  // size x size x 3, sRGB: lit from above, for matching
  std::vector<std::uint8_t>
      normals;  // size x size x 3, tangent-space: right, up, out, 0 for -1 and 255 for 1
};
WaveImages makeWaves(const Waves& options = {});

}  // namespace fluidtex::exemplars
