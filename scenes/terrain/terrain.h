// Ground by rule: heights for the scenes that ship.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::terrain {

// Heights in metres, rows from the picture's top (high y) to its bottom (y = 0).
struct Ground {
  int width = 0, height = 0;
  double pixel = 0.0;          // metres
  std::vector<float> heights;  // height x width
};

// A stream bed along x, 4 x 2 m: a bend, a narrowing at x = 1.9 m, a small fall at 2.7 m, rocks. Its floor
// lies at 0.40 m at x = 0 and at about 0.17 m at the end; its banks rise by 0.3 m.
Ground streamBed();

// A mountain with a crater at its top, 3 x 3 m: the crater's floor lies 0.86 m high at (1.5, 1.5), its rim,
// 0.3 m from there, at 1.02 m, with two notches, towards low y and between there and high x, from which
// gullies run down. Ribs grow downwards; the picture's edges lie 0.02 to 0.16 m high.
Ground mountain();

// Grey values of 16 bits: 0 at height `low`, 65535 at `high`; what lies beyond is cut off.
std::vector<std::uint16_t> greyValues(const Ground& ground, double low, double high);

}  // namespace fluidtex::terrain
