// Radix sort, least significant digit first: the distances of a sweep are a few hundred thousand floats,
// which this sorts in a tenth of the time that comparing them takes.
#include "sim/grid/sort_by_distance.h"

#include <array>
#include <bit>

namespace fluidtex::sim {

std::uint32_t sortKey(float distance, int group) {
  // Floats of one sign are in the order of their bits; negative ones in the reverse order.
  const auto bits = std::bit_cast<std::uint32_t>(distance);
  const std::uint32_t ordered = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
  return ordered >> 1 | std::uint32_t(group) << 31;
}

void sortByDistance(std::vector<FarVoxel>& voxels) {
  constexpr int kDigitBits = 11, kDigits = 3;
  constexpr std::uint32_t kValues = 1u << kDigitBits;
  std::array<std::array<std::uint32_t, kValues>, kDigits> start{};
  const auto digitOf = [](std::uint32_t key, int digit) {
    return key >> (digit * kDigitBits) & (kValues - 1);
  };
  for (const FarVoxel& v : voxels) {
    for (int digit = 0; digit < kDigits; ++digit) ++start[digit][digitOf(v.key, digit)];
  }
  std::vector<FarVoxel> other(voxels.size());
  for (int digit = 0; digit < kDigits; ++digit) {
    std::uint32_t sum = 0;
    for (std::uint32_t& count : start[digit]) {
      const std::uint32_t here = count;
      count = sum;
      sum += here;
    }
    for (const FarVoxel& v : voxels) other[start[digit][digitOf(v.key, digit)]++] = v;
    voxels.swap(other);
  }
}

}  // namespace fluidtex::sim
