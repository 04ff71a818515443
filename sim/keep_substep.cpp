#include "sim/keep_substep.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {
namespace {

// Whether a solid's surface lies within 3 cells of one of this leaf's: what follows it along a step and its
// interpolation reach no farther, solids moving by at most one.
bool nearSolid(const FloatGrid& solid, const Coord& origin) {
  const FloatLeaf* leaf = solid.constTree().probeConstLeaf(origin);
  return leaf != nullptr && !leaf->isEmpty();
}

}  // namespace

Substep keepSubstep(double dt, const Velocity& velocity, const FloatGrid& phi,
                    const std::vector<const FloatGrid*>& solids) {
  const auto& [u, v, w] = velocity.component;
  const auto leaves = leavesOf(u->constTree());
  std::vector<std::uint8_t> keep(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves[n]->origin();
    keep[n] = phi.constTree().probeConstLeaf(origin) != nullptr ||
              std::any_of(solids.begin(), solids.end(),
                          [&](const FloatGrid* solid) { return nearSolid(*solid, origin); });
  });
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return {dt, u, v, w};
  FloatGrid::Ptr kept[3];
  for (int axis = 0; axis < 3; ++axis) {
    const FloatGrid& whole = *velocity.component[axis];
    kept[axis] = FloatGrid::create(whole.background());
    kept[axis]->insertMeta(whole);
    kept[axis]->setTransform(faceTransform(whole.voxelSize()[0], axis));
    for (std::size_t n = 0; n < leaves.size(); ++n) {
      if (keep[n] != 0)
        kept[axis]->tree().addLeaf(new FloatLeaf(*whole.constTree().probeConstLeaf(leaves[n]->origin())));
    }
  }
  return {dt, kept[0], kept[1], kept[2]};
}

}  // namespace fluidtex::sim
