#include "sim/step/keep_substep.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace fluidtex::sim {
namespace {

// Whether a solid's surface lies within 3 cells of one of this leaf's. A point that follows the surface for a
// step, with its interpolation, reaches no farther, as solids move by at most one cell.
bool nearSolid(const FloatGrid& solid, const Coord& origin) {
  const FloatLeaf* leaf = solid.constTree().probeConstLeaf(origin);
  return leaf != nullptr && !leaf->isEmpty();
}

}  // namespace

Velocity nearSurface(const Velocity& velocity, const FloatGrid& phi,
                     const std::vector<const FloatGrid*>& solids) {
  const auto leaves = leavesOf(velocity.component[0]->constTree());
  std::vector<std::uint8_t> keep(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves[n]->origin();
    keep[n] = phi.constTree().probeConstLeaf(origin) != nullptr ||
              std::any_of(solids.begin(), solids.end(),
                          [&](const FloatGrid* solid) { return nearSolid(*solid, origin); });
  });
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return velocity;
  Velocity kept;
  for (int axis = 0; axis < 3; ++axis) {
    const FloatGrid& whole = *velocity.component[axis];
    FloatGrid::Ptr& part = kept.component[axis];
    part = FloatGrid::create(whole.background());
    part->insertMeta(whole);
    part->setTransform(faceTransform(whole.voxelSize()[0], axis));
    for (std::size_t n = 0; n < leaves.size(); ++n) {
      if (keep[n] != 0)
        part->tree().addLeaf(new FloatLeaf(*whole.constTree().probeConstLeaf(leaves[n]->origin())));
    }
  }
  return kept;
}

Substep keepSubstep(double dt, const Velocity& velocity, const FloatGrid& phi,
                    const std::vector<const FloatGrid*>& solids,
                    std::shared_ptr<const Visibility> visibility) {
  const Velocity kept = nearSurface(velocity, phi, solids);
  return {dt, kept.component[0], kept.component[1], kept.component[2], std::move(visibility)};
}

}  // namespace fluidtex::sim
