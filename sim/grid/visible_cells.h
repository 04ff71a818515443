// Visibility of the cells around one: which of them lie on its side of a thin solid, and their values.
#pragma once

#include <array>
#include <cstdint>

namespace fluidtex::sim {

// The cells visible from one cell, of the 5 x 5 x 5 around it, and whether its centre is in a solid.
struct VisibleCells {
  static constexpr int kReach = 2, kSide = 2 * kReach + 1, kCount = kSide * kSide * kSide;
  static constexpr int kStride[3] = {kSide * kSide, kSide, 1};
  static constexpr int kMiddle = kReach * (kStride[0] + kStride[1] + kStride[2]);

  static constexpr std::array<std::uint64_t, 2> kNear = [] {
    std::array<std::uint64_t, 2> near{};
    for (int n = 0; n < 27; ++n) {
      const int at = kMiddle + (n / 9 - 1) * kStride[0] + (n / 3 % 3 - 1) * kStride[1] + n % 3 - 1;
      near[at >> 6] |= std::uint64_t{1} << (at & 63);
    }
    return near;
  }();
  // In bits[1], behind those of the cells.
  static constexpr std::uint64_t kOutsideBit = std::uint64_t{1} << (kCount - 64);

  std::array<std::uint64_t, 2> bits{~std::uint64_t{0}, ~std::uint64_t{0}};

  // at: kMiddle + i kStride[0] + j kStride[1] + k kStride[2] for the cell (i, j, k) away.
  bool sees(int at) const { return (bits[at >> 6] >> (at & 63) & 1) != 0; }
  // The middle cell and the 26 around it.
  bool seesNear() const { return (~bits[0] & kNear[0]) == 0 && (~bits[1] & kNear[1]) == 0; }
  bool seesAll() const {
    return bits[0] == ~std::uint64_t{0} && (bits[1] | kOutsideBit) == ~std::uint64_t{0};
  }
  void show(int at) { bits[at >> 6] |= std::uint64_t{1} << (at & 63); }
  void hide(int at) { bits[at >> 6] &= ~(std::uint64_t{1} << (at & 63)); }
  bool isInSolid() const { return (bits[1] & kOutsideBit) == 0; }
  void setInSolid() { bits[1] &= ~kOutsideBit; }
};

// A field's values in the cells around one.
using Stencil = std::array<float, VisibleCells::kCount>;

}  // namespace fluidtex::sim
