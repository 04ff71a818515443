#include "sim/poured_surface.h"

#include "sim/normal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// In cells: no surface farther away lies between two cells; and a body this near a solid touches it.
constexpr double kNear = 1.8, kTouching = 0.05;
// Halvings of a way between cells.
constexpr int kHalvings = 40;

using Distance = std::function<double(const Vec3d&)>;

// The place between two where a distance changes its sign. low: at `from`.
Vec3d crossing(const ShapeDistance& distance, Vec3d from, Vec3d to, double low) {
  for (int n = 0; n < kHalvings; ++n) {
    const Vec3d middle = 0.5 * (from + to);
    ((distance(middle) < 0.0) == (low < 0.0) ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

// Of a plane from how far away it crosses the axes (ways to the six cells beside); 0 where it crosses none.
double distanceAcross(const ShapeDistance& body, const Distance& solids, const Vec3d& x, double here,
                      double h) {
  // Where the body ends at a solid itself, the solid is no way off; a surface beside one is as far from it as
  // x.
  const double apart = std::min(kTouching * h, 0.5 * solids(x));
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double nearest = kForever;
    for (const double way : {-h, h}) {
      Vec3d beside = x;
      beside[axis] += way;
      if ((body(beside) < 0.0) == (here < 0.0)) continue;
      const Vec3d place = crossing(body, x, beside, here);
      if (solids(place) > apart) nearest = std::min(nearest, (place - x).length());
    }
    // A surface through the centre itself is as far away as rounding.
    nearest = std::max(nearest, 1e-6 * h);
    squares += 1.0 / (nearest * nearest);
  }
  return squares > 0.0 ? 1.0 / std::sqrt(squares) : 0.0;
}

}  // namespace

Distance pouredSurface(const ShapeDistance& body, Distance solids, double h) {
  return [body, solids = std::move(solids), h](const Vec3d& x) {
    double here = body(x);
    const double touching = kTouching * h;
    if (std::abs(here) > kNear * h) return here;
    const double room = solids(x);
    if (room > std::abs(here) + touching) return here;
    // Between a body and a solid that it all but touches there is no air.
    Vec3d place = x;
    if (room > 0.0 && room < touching) {
      const Vec3d beside = x + touching * normalAt(solids, x, 0.01 * h);
      if ((body(beside) < 0.0) != (here < 0.0)) {
        place = beside;
        here = body(place);
      }
    }
    const Vec3d closest = place - here * normalAt(body, place, 0.01 * h);
    if (place == x && solids(closest) > touching) return here;
    const double across = distanceAcross(body, solids, place, here, h);
    const double away = across > 0.0 ? across : std::abs(here);
    return here < 0.0 ? -away : away;
  };
}

}  // namespace fluidtex::sim
