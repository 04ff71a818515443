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

// Lava at all stages of cooling side by side, from melt with a few rafts of skin on it, over cracks that
// close, to dark crust; and a map that tells them apart, by which a scene can let temperature choose.
struct CoolingLava {
  std::vector<std::uint8_t> pixels;  // as of makeLava()
  std::vector<std::uint8_t>
      guidance;  // size x size: 0 cold, 255 molten, each level about as often as the others
};
inline constexpr Lava kCooling{.size = 384, .plates = 20};
CoolingLava makeCoolingLava(const Lava& options = kCooling);

// One stage of cooling everywhere, 0: dark crust, to 1: melt with a few rafts of skin on it, on plates that
// stay where they are: pictures for an exemplar that moves, by temperature.
inline constexpr Lava kLavaStages{.size = 192, .plates = 10};
std::vector<std::uint8_t> makeLavaAtStage(double stage, const Lava& options = kLavaStages);

}  // namespace fluidtex::exemplars
