// Molten lava seen from above: dark plates of crust, and the glow between them.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Lava {
  int size = 256;   // pixels, width and height
  int plates = 13;  // plates across
  int samples = 3;  // a pixel's side, for anti-aliasing
  std::uint64_t seed = 11;
};

// Plates of cooled crust, matt and wrinkled, with cracks between them that glow from red at their edges to
// yellow in their middle, wide and narrow. Toroidal. size x size x 3, sRGB, rows from the top.
std::vector<std::uint8_t> makeLava(const Lava& options = {});

}  // namespace fluidtex::exemplars
