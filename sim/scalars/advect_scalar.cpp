// Based on: Selle, Fedkiw, Kim, Liu and Rossignac, "An unconditionally stable MacCormack method", 2008; see
// advect_velocity.cpp.
#include "sim/scalars/advect_scalar.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/velocity_window.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/solids/own_side_trace.h"
#include "sim/solids/trace_end.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

FloatGrid::Ptr advectScalar(const FloatGrid& from, const Velocity& velocity, const FloatTree& like,
                            const FloatGrid& phiTo, const SolidField& solid, double dt) {
  const double h = from.voxelSize()[0];
  const float step = static_cast<float>(dt / h);
  const int halo = std::min(kLeafDim, static_cast<int>(std::ceil(dt * maxAbs(velocity) / h)) + 2);
  const FloatGrid::Ptr first = makeScalar(from, like);
  FloatGrid::Ptr result = makeScalar(from, like);
  const auto guess = leavesOf(first->tree()), target = leavesOf(result->tree());
  const Vec3f centre(0.5f);
  using Range = tbb::blocked_range<std::size_t>;
  // Calls body(leaf, offset, place) for the liquid's cells of a leaf, places in cells from its lower corner.
  const auto forLiquid = [&](const auto& begin, const auto& body) {
    tbb::parallel_for(Range(0, target.size()), [&](const Range& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) {
        float scratch[kLeafSize];
        const float* phi = leafValues(phiTo.constTree(), target[n]->origin(), scratch);
        if (std::all_of(phi, phi + kLeafSize, [](float p) { return p >= 0.0f; })) continue;
        auto windows = begin(target[n]->origin());
        for (int i = 0; i < kLeafSize; ++i) {
          if (phi[i] >= 0.0f) continue;
          const Vec3f x(static_cast<float>(i >> 6) + 0.5f, static_cast<float>((i >> 3) & 7) + 0.5f,
                        static_cast<float>(i & 7) + 0.5f);
          body(windows, n, i, x);
        }
      }
    });
  };
  struct Windows {
    VelocityWindow flow;
    Window before, predicted;
    TraceEnd end;
    const Visibility* visibility;
    Coord origin;
    // From a cell's centre.
    Vec3f trace(int offset, const Vec3f& x, float step) const {
      Vec3f to = flow.trace(x, step);
      if (end.nearThinWalls()) {
        const auto speed = [&](int axis, const Vec3f& at) { return step * flow.component(axis).at(at); };
        const OwnSideTrace ownSide(*visibility, origin, speed);
        to = ownSide.corrected(x, ownSide.cellAt(x), to);
      }
      return end.onOwnSide(offset, x, to);
    }
  };
  const auto load = [&](const Coord& origin) {
    Windows windows{VelocityWindow(halo),   Window(halo, centre),
                    Window(halo, centre),   TraceEnd(*solid.phi, solid.visibility.get()),
                    solid.visibility.get(), origin};
    windows.end.setLeaf(origin, halo);
    windows.flow.load(velocity, origin);
    windows.before.load(from.constTree(), origin);
    return windows;
  };
  forLiquid(load, [&](const Windows& windows, std::size_t n, int i, const Vec3f& x) {
    guess[n]->buffer().data()[i] = windows.before.at(windows.trace(i, x, -step));
  });
  const auto loadBoth = [&](const Coord& origin) {
    Windows windows = load(origin);
    windows.predicted.load(first->constTree(), origin);
    return windows;
  };
  forLiquid(loadBoth, [&](const Windows& windows, std::size_t n, int i, const Vec3f& x) {
    const float plain = guess[n]->buffer().data()[i];
    const auto [low, high] = windows.before.range(windows.trace(i, x, -step));
    const float back = windows.predicted.at(windows.trace(i, x, step));
    target[n]->buffer().data()[i] = std::clamp(plain + 0.5f * (windows.before.at(x) - back), low, high);
  });
  return result;
}

}  // namespace fluidtex::sim
