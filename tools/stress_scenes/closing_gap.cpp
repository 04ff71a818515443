#include "tools/stress_scenes/closing_gap.h"

#include "sim/grid/normal.h"
#include "sim/solids/domain.h"
#include "sim/solids/solids.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace fluidtex::stress {
namespace {

using sim::Vec3d;
using Distance = std::function<double(const Vec3d&)>;

// In cells: the least step towards the other side of a gap; how far a surface moves forward in a second of
// which it counts as moving.
constexpr double kStep = 0.05, kMoves = 0.01;

// The distance along a direction to where another is 0; infinite where it is not, within `farthest`.
double reach(const Distance& other, const Vec3d& from, const Vec3d& way, double farthest, double step) {
  for (double gone = 0.0; gone < farthest;) {
    const double left = other(from + gone * way);
    if (left <= 0.0) return gone;
    gone += std::max(left, step);
  }
  return INFINITY;
}

sim::Options withSolids(const sim::Options& options, const std::function<bool(std::size_t)>& wanted) {
  sim::Options some = options;
  some.solids.clear();
  for (std::size_t n = 0; n < options.solids.size(); ++n)
    if (wanted(n)) some.solids.push_back(options.solids[n]);
  return some;
}

}  // namespace

double closingGap(const sim::Options& options, double time) {
  const double h = options.voxelSize(), soon = 1e-3 / options.frameRate;
  double narrowest = INFINITY;
  for (std::size_t moving = 0; moving < options.solids.size(); ++moving) {
    const sim::Solid& solid = options.solids[moving];
    if (solid.keyframes.size() < 2 || time < solid.from || time >= solid.until) continue;
    sim::Options alone = withSolids(options, [&](std::size_t n) { return n == moving; });
    alone.sides.fill(sim::Side::unbounded);
    const sim::Solids itself(alone), rest(withSolids(options, [&](std::size_t n) { return n != moving; }));
    const Distance now = itself.distanceAt(time), then = itself.distanceAt(time + soon),
                   others = rest.distanceAt(time);
    const sim::CoordBBox cells = sim::firstCells(sim::cellCount(options.size, h));
    for (auto cell = cells.begin(); cell; ++cell) {
      const Vec3d x = ((*cell).asVec3d() + Vec3d(0.5)) * h;
      const double away = now(x);
      if (std::abs(away) > 0.87 * h) continue;
      const Vec3d normal = sim::normalAt(now, x, 0.01 * h), place = x - away * normal;
      if ((now(place) - then(place)) / soon < kMoves * h || others(place) <= 0.0) continue;
      narrowest = std::min(narrowest, reach(others, place, normal, options.size.length(), kStep * h));
    }
  }
  return narrowest;
}

}  // namespace fluidtex::stress
