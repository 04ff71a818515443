#include "sim/surface/mirror_sides.h"

#include <tbb/parallel_for.h>

namespace fluidtex::sim {
namespace {

void mirrorAt(FloatGrid& phi, const SolidField& solid, int side) {
  const int axis = side / 2;
  const bool low = side % 2 == 0;
  const int first = low ? solid.domain.min()[axis] : solid.domain.max()[axis] + 1;
  const auto leaves = leavesOf(phi.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    FloatLeaf& leaf = *leaves[n];
    const int begin = leaf.origin()[axis];
    if (low ? begin >= first : begin + kLeafDim <= first) return;
    // Reads on one side of the plane and writes on the other only, so leaves may run in parallel.
    const openvdb::tree::ValueAccessor<const FloatTree> values(phi.constTree());
    for (int i = 0; i < kLeafSize; ++i) {
      Coord at = leaf.offsetToGlobalCoord(i);
      if (low ? at[axis] >= first : at[axis] < first) continue;
      at[axis] = 2 * first - 1 - at[axis];
      leaf.setValueOnly(i, values.getValue(at));
    }
  });
}

}  // namespace

void mirrorAtSides(FloatGrid& phi, const SolidField& solid) {
  for (int side = 0; side < 6; ++side)
    if (solid.sides[side] == Side::symmetry) mirrorAt(phi, solid, side);
}

}  // namespace fluidtex::sim
