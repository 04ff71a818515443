#include "sim/keep_substep.h"

#include "sim/local_reach.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// Voxels from a place to those that an interpolation there reads, gradients included.
constexpr float kAround = 3.0f;

// Whether a solid's surface lies within 3 cells of one of this leaf's: what follows it along a step and its
// interpolation reach no farther, solids moving by at most one.
bool nearSolid(const FloatGrid& solid, const Coord& origin) {
  const FloatLeaf* leaf = solid.constTree().probeConstLeaf(origin);
  return leaf != nullptr && !leaf->isEmpty();
}

// Whether the surface lies within `distance` (metres) of a voxel of this leaf.
bool nearSurface(const FloatGrid& phi, const Coord& origin, float distance) {
  const FloatLeaf* leaf = phi.constTree().probeConstLeaf(origin);
  if (leaf == nullptr) return false;
  const float* value = leaf->buffer().data();
  return std::any_of(value, value + kLeafSize, [&](float at) { return std::abs(at) <= distance; });
}

// The velocity in the leaves whose origins `near` accepts.
template <typename Near>
Velocity partOf(const Velocity& velocity, const Near& near) {
  const auto leaves = leavesOf(velocity.component[0]->constTree());
  std::vector<std::uint8_t> keep(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(),
                    [&](std::size_t n) { keep[n] = near(leaves[n]->origin()); });
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

}  // namespace

Velocity nearSurface(const Velocity& velocity, const FloatGrid& phi) {
  return partOf(velocity,
                [&](const Coord& origin) { return phi.constTree().probeConstLeaf(origin) != nullptr; });
}

Substep keepSubstep(double dt, const Velocity& velocity, const std::array<const FloatGrid*, 2>& surfaces,
                    const std::array<const FloatGrid*, 2>& solids) {
  const LocalReach reach(velocity, dt);
  const float h = static_cast<float>(velocity.component[0]->voxelSize()[0]);
  const Velocity kept = partOf(velocity, [&](const Coord& origin) {
    const float distance = h * (kAround + 0.5f * std::sqrt(3.0f) * reach.from(origin));
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [&](const FloatGrid* phi) { return nearSurface(*phi, origin, distance); }) ||
           std::any_of(solids.begin(), solids.end(),
                       [&](const FloatGrid* solid) { return nearSolid(*solid, origin); });
  });
  return {dt, kept.component[0], kept.component[1], kept.component[2]};
}

}  // namespace fluidtex::sim
