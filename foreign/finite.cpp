#include "foreign/finite.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace fluidtex::foreign::here {
namespace {

bool isFinite(float value) {
  return std::isfinite(value);
}

bool isFinite(const openvdb::Vec3s& value) {
  return isFinite(value[0]) && isFinite(value[1]) && isFinite(value[2]);
}

// Of many at once, without a branch for each.
bool areFinite(std::span<const float> values) {
  constexpr std::uint32_t kExponent = 0x7f800000u;
  std::uint32_t wrong = 0;
  for (const float value : values)
    wrong |= std::uint32_t((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  return wrong == 0;
}

}  // namespace

template <class Grid>
void refuseNonFinite(const Grid& grid, const std::string& label) {
  using Value = typename Grid::ValueType;
  using Leaf = typename Grid::TreeType::LeafNodeType;
  std::uint64_t count = 0;
  openvdb::Coord first = openvdb::Coord::max();
  const auto found = [&](const openvdb::Coord& place, std::uint64_t voxels) {
    count += voxels;
    first = std::min(first, place);
  };
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const auto* values = reinterpret_cast<const float*>(leaf->buffer().data());
    if (areFinite({values, Leaf::SIZE * sizeof(Value) / sizeof(float)})) continue;
    for (auto value = leaf->cbeginValueOn(); value; ++value)
      if (!isFinite(*value)) found(value.getCoord(), 1);
  }
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(Grid::TreeType::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
    if (!isFinite(*tile)) found(tile.getCoord(), tile.getVoxelCount());
  if (count == 0) return;
  throw Unreadable(label + " has " + std::to_string(count) + " active " + (count == 1 ? "voxel" : "voxels") +
                   " without a finite value, the first at (" + std::to_string(first.x()) + ", " +
                   std::to_string(first.y()) + ", " + std::to_string(first.z()) +
                   "), and finite ones are needed");
}

template void refuseNonFinite(const openvdb::FloatGrid&, const std::string&);
template void refuseNonFinite(const openvdb::Vec3SGrid&, const std::string&);

}  // namespace fluidtex::foreign::here
