// Water whose small waves move: pictures for an exemplar that moves.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Ripples {
  int size = 192, samples = 2;
  int pictures = 24;  // of one loop
  int waves = 40;
  std::uint64_t seed = 5;
};

// The n-th picture, sRGB, toroidal; the first follows the last.
std::vector<std::uint8_t> makeRipples(const Ripples& options, int n);

}  // namespace fluidtex::exemplars
