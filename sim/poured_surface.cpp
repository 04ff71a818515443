#include "sim/poured_surface.h"

#include "sim/normal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// In cells: no surface farther away lies between two cells; and a body this near a solid touches it.
constexpr double kNear = 1.8, kTouching = 0.05;
// Cells along an axis in which a surface is looked for, and their parts: a wall is no thinner.
constexpr int kReach = 2, kParts = 4;
// Cosine of the angle between two surfaces that are one; and how far into a solid a body may be put, in
// cells.
constexpr double kParallel = 0.99, kInto = 0.5;
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

// Whether a body ends at a solid here, at a place on its surface: there they are one, or the body has been
// put a little into the solid. Where one surface cuts the other it goes on into the solid.
bool isAtSolid(const ShapeDistance& body, const Distance& solids, const Vec3d& place, double apart,
               double h) {
  const double away = solids(place);
  if (away > apart || away < -kInto * h) return false;
  return std::abs(normalAt(body, place, 0.01 * h).dot(normalAt(solids, place, 0.01 * h))) > kParallel;
}

// Of a plane from how far away it crosses the axes (ways to the six cells beside); 0 where it crosses none.
double distanceAcross(const ShapeDistance& body, const Distance& solids, const Vec3d& x, double here,
                      double h) {
  // Where the body ends at a solid itself, the solid is no way off; a surface beside one is as far from it as
  // x.
  const double apart = std::min(kTouching * h, 0.5 * std::abs(solids(x)));
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double nearest = kForever;
    for (const double part : {-h / kParts, h / kParts}) {
      Vec3d from = x;
      bool wasOpen = solids(x) > 0.0, entered = false;
      for (int n = 0; n < kReach * kParts; ++n) {
        Vec3d beside = from;
        beside[axis] += part;
        if ((body(beside) < 0.0) != (here < 0.0)) {
          const Vec3d place = crossing(body, from, beside, here);
          if (!isAtSolid(body, solids, place, apart, h)) nearest = std::min(nearest, (place - x).length());
          break;
        }
        // Into a solid, where the surface goes on, but not through it.
        const bool isOpen = solids(beside) > 0.0;
        if (isOpen && entered) break;
        entered = entered || (wasOpen && !isOpen);
        wasOpen = isOpen;
        from = beside;
      }
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
    // As near to two surfaces, the way to one leads past both.
    const bool isOn = std::abs(body(closest)) < touching;
    if (place == x && isOn && !isAtSolid(body, solids, closest, touching, h)) return here;
    if (const double across = distanceAcross(body, solids, place, here, h); across > 0.0)
      return here < 0.0 ? -across : across;
    // What the body ends at is the solid; its surface is farther away.
    return here < 0.0 ? std::min(here, -kNear * h) : here;
  };
}

}  // namespace fluidtex::sim
