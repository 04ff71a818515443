#include "sim/grid/voxel_mask.h"

namespace fluidtex::sim {

LeafBits besideThose(const LeafTable& table, const VoxelMask& mask, std::size_t leaf, int direction) {
  constexpr std::uint64_t kFirst = 0x0101010101010101ull, kLast = kFirst << 7;  // in a row along z
  const int next = table.next[leaf][static_cast<std::size_t>(direction)];
  const LeafBits none{}, &own = mask[leaf], &other = next < 0 ? none : mask[static_cast<std::size_t>(next)];
  LeafBits bits{};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    switch (direction) {
      case 0:
        bits[i] = i > 0 ? own[i - 1] : other.back();
        break;
      case 1:
        bits[i] = i + 1 < bits.size() ? own[i + 1] : other.front();
        break;
      case 2:
        bits[i] = own[i] << 8 | other[i] >> 56;
        break;
      case 3:
        bits[i] = own[i] >> 8 | other[i] << 56;
        break;
      case 4:
        bits[i] = (own[i] << 1 & ~kFirst) | (other[i] >> 7 & kFirst);
        break;
      default:
        bits[i] = (own[i] >> 1 & ~kLast) | (other[i] << 7 & kLast);
        break;
    }
  }
  return bits;
}

LeafBits besideAny(const LeafTable& table, const VoxelMask& mask, std::size_t leaf) {
  LeafBits bits{};
  for (int direction = 0; direction < 6; ++direction) {
    const LeafBits there = besideThose(table, mask, leaf, direction);
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] |= there[i];
  }
  return bits;
}

}  // namespace fluidtex::sim
