// Cells of a block that the zero set crosses.
#pragma once

#include "numerics/lanes.h"
#include "texture/levelset/level_set.h"

#include <array>
#include <bit>

namespace fluidtex::texture {

// Calls body(x, y, z, pointer to the value at the lowest corner) for each cell of a block whose corners
// differ in sign, x slowest. values: as LevelSet::values.
template <typename Body>
void forCrossedCells(const float* values, const Body& body) {
  constexpr int kSide = kBlockSide, kPadded = kBlockPadded;
  const auto row = [&](int x, int y) { return values + ((x + 1) * kPadded + y + 1) * kPadded + 1; };
  // One bit per value, one row along z at a time.
  std::array<std::array<unsigned, kSide + 1>, kSide + 1> inside;
  for (int x = 0; x <= kSide; ++x)
    for (int y = 0; y <= kSide; ++y)
      inside[std::size_t(x)][std::size_t(y)] =
          below8(load8(row(x, y)), 0.0f) | unsigned(row(x, y)[kSide] < 0.0f) << kSide;
  for (std::size_t x = 0; x < kSide; ++x) {
    for (std::size_t y = 0; y < kSide; ++y) {
      const unsigned a = inside[x][y], b = inside[x + 1][y], c = inside[x][y + 1], d = inside[x + 1][y + 1];
      const unsigned any = a | b | c | d, all = a & b & c & d;
      for (unsigned crossed = (any | any >> 1) & ~(all & all >> 1) & 0xffu; crossed != 0;
           crossed &= crossed - 1) {
        const int z = std::countr_zero(crossed);
        body(int(x), int(y), z, row(int(x), int(y)) + z);
      }
    }
  }
}

}  // namespace fluidtex::texture
