// Based on: Stam, "Stable fluids", 1999 (semi-Lagrangian); Ralston, "Runge-Kutta methods with minimum error
// bounds", 1962 (third-order trace).
#include "sim/velocity/advect_velocity.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/local_reach.h"
#include "sim/grid/velocity_window.h"
#include "sim/solids/own_side_trace.h"
#include "sim/solids/trace_end.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// Centre of a cell's lower face, in cells from the leaf's lower corner.
Vec3f faceCentre(int offset, int axis) {
  const Vec3f corner(static_cast<float>(offset >> 6), static_cast<float>((offset >> 3) & 7),
                     static_cast<float>(offset & 7));
  return corner + faceShift(axis);
}

}  // namespace

void advectVelocity(const Velocity& from, const Velocity& carried, Velocity& to, const FloatGrid& phi,
                    const FloatGrid& solidPhi, double dt, const Visibility* visibility) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  const float step = static_cast<float>(-dt) / h;
  const LocalReach reach(from, dt);
  std::array<std::vector<FloatLeaf*>, 3> leaves;
  for (int a = 0; a < 3; ++a) leaves[a] = leavesOf(to.component[a]->tree());
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, leaves[0].size()), [&](const Range& range) {
    VelocityWindow window(kLeafDim), content(kLeafDim);
    Window distance(1, Vec3f(0.5f));
    TraceEnd end(solidPhi, visibility);
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const Coord origin = leaves[0][n]->origin();
      distance.load(phi.constTree(), origin);
      const float* const first = distance.values.get();
      const std::ptrdiff_t side = distance.side;
      if (std::all_of(first, first + side * side * side, [](float p) { return p >= 0.0f; })) continue;
      // The reach of traces, and two samples more for the cubic.
      const int halo = std::min(kLeafDim, static_cast<int>(std::ceil(reach.from(origin))) + 3);
      window.setHalo(halo);
      content.setHalo(halo);
      window.load(from, origin);
      content.load(carried, origin);
      end.setLeaf(origin, halo);
      for (int axis = 0; axis < 3; ++axis) {
        const FloatLeaf& leaf = *leaves[axis][n];
        const std::ptrdiff_t below = axis == 0 ? side * side : (axis == 1 ? side : 1);
        const auto touchesLiquid = [&](int i) {
          const float* above = first + (((i >> 6) + 1) * side + ((i >> 3) & 7) + 1) * side + (i & 7) + 1;
          return leaf.isValueOn(i) && (above[0] < 0.0f || above[-below] < 0.0f);
        };
        const Window& own = content.component(axis);
        float* const out = leaves[axis][n]->buffer().data();
        const auto speed = [&](int a, const Vec3f& x) { return step * window.component(a).at(x); };
        const auto take = [&](int i, Vec3f place) {
          const Vec3f centre = faceCentre(i, axis);
          if (end.nearThinWalls()) {
            const OwnSideTrace trace(*visibility, origin, speed);
            // The cell that the trace leads into.
            Coord cell(i >> 6, (i >> 3) & 7, i & 7);
            if (place[axis] < centre[axis]) --cell[axis];
            place = trace.corrected(centre, cell, place);
          }
          place = end.onOwnSide(i, centre, place, axis);
          const auto [low, high] = own.range(place);
          out[i] = std::clamp(own.cubic(place), low, high);
        };
        forPairs(touchesLiquid, [&](int i, int other) {
          const auto [place, otherPlace] = window.traceFaces(i, other, axis, step);
          take(i, place);
          take(other, otherPlace);
        });
      }
    }
  });
}

}  // namespace fluidtex::sim
