// Example images made by rule: they ship with the scenes and owe nothing to anyone's photographs.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::exemplars {

struct Scales {
  int size = 256;    // pixels, width and height
  int columns = 16;  // scales across; the image must hold a whole number of them to be toroidal
  int rows = 22;     // even: every second row is shifted by half a scale
  int samples = 4;   // a pixel's side, for anti-aliasing
  std::uint64_t seed = 7;
};

// Overlapping green reptile scales, each with its own shade and slightly its own shape; free ends point down.
// Toroidal: the left edge continues at the right, the top at the bottom. size x size x 3, sRGB, rows from the
// top.
std::vector<std::uint8_t> makeGreenScales(const Scales& options = {});

// How high they stand, over the same image: 0 (black) in the gaps to 1 on the raised ends. size x size, one
// byte each.
std::vector<std::uint8_t> makeScalesHeight(const Scales& options = {});

}  // namespace fluidtex::exemplars
