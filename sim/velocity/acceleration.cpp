#include "sim/velocity/acceleration.h"

#include "sim/grid/leaf_table.h"

#include <tbb/parallel_for.h>

namespace fluidtex::sim {

Velocity plus(const Velocity& u, const Velocity& a, double time) {
  const float factor = static_cast<float>(time);
  Velocity sum = copyOf(u);
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(sum.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const FloatLeaf* from = a.component[axis]->constTree().probeConstLeaf(leaves[n]->origin());
      if (from == nullptr) return;
      float* to = leaves[n]->buffer().data();
      const float* add = from->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) to[i] += factor * add[i];
    });
  }
  return sum;
}

Velocity accelerationBy(Velocity before, const Velocity& after, const FaceMasks& valid, double dt) {
  const auto& masks = valid.component;
  const float rate = static_cast<float>(1.0 / dt);
  for (int axis = 0; axis < 3; ++axis) {
    before.component[axis]->tree().topologyUnion(after.component[axis]->constTree());
    const auto leaves = leavesOf(before.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const Coord& origin = leaves[n]->origin();
      const auto* mask = masks[axis]->constTree().probeConstLeaf(origin);
      float scratch[kLeafSize];
      const float* is = leafValues(after.component[axis]->constTree(), origin, scratch);
      float* value = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i)
        value[i] = mask != nullptr && mask->isValueOn(i) ? (is[i] - value[i]) * rate : 0.0f;
    });
  }
  return before;
}

}  // namespace fluidtex::sim
