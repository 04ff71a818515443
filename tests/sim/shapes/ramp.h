// A picture of heights known in closed form.
#pragma once

#include <string>

namespace fluidtex::sim {

// A PGM of 64 x 32 pixels of 16 bits: rises evenly from left to right by 512 a pixel, and from bottom to top
// by half as much.
inline std::string ramp() {
  std::string text = "P5 64 32 65535\n";
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 64; ++column) {
      const int value = 512 * column + 256 * (31 - row);
      text += static_cast<char>(value >> 8);
      text += static_cast<char>(value & 255);
    }
  }
  return text;
}

}  // namespace fluidtex::sim
