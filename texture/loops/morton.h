// Order along a space-filling curve (Morton code), for locality.
#pragma once

#include <cstdint>

namespace fluidtex::texture {

// Spreads the bits of x to every third position.
inline std::uint64_t spreadBits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

// Coordinates from -2^20 to 2^20 - 1; others wrap.
inline std::uint64_t mortonCode(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::int64_t kOffset = 1 << 20;
  return spreadBits(std::uint64_t(x + kOffset)) << 2 | spreadBits(std::uint64_t(y + kOffset)) << 1 |
         spreadBits(std::uint64_t(z + kOffset));
}

}  // namespace fluidtex::texture
