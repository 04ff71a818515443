#include "sim/surface/poured_surface.h"

#include "sim/grid/normal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// In cells: no surface farther away lies between two cells; and a body this near a solid touches it.
constexpr double kNear = 1.8, kTouching = 0.05;
// Cells along an axis in which a surface is looked for, and into how many parts each is split.
constexpr int kReach = 2, kParts = 4;
// Cosine of the angle between two surfaces that are taken for parallel.
constexpr double kParallel = 0.99;
// Cells: where a body's surface, parallel to that of the solid it lies in, is looked for outside.
constexpr double kAround[] = {2.0, 5.0, 12.0};
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

// Whether the body's surface comes out of the solid near a place in it. normal: the surface's there.
bool comesOut(const ShapeDistance& body, const Distance& solids, const Vec3d& place, const Vec3d& normal,
              double h) {
  int least = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(normal[a]) < std::abs(normal[least])) least = a;
  Vec3d axis(0.0);
  axis[least] = 1.0;
  const Vec3d one = normal.cross(axis).unit(), other = normal.cross(one);
  for (const double cells : kAround) {
    for (const Vec3d& way : {one, -one, other, -other}) {
      const Vec3d there = place + cells * h * way;
      if (std::abs(body(there)) < 0.5 * h && solids(there) > kTouching * h) return true;
    }
  }
  return false;
}

// Whether a body ends at a solid, at a place on its surface: there the two surfaces are one, or the body has
// been put some way into the solid. Where one cuts the other, the body's goes on into the solid.
bool isAtSolid(const ShapeDistance& body, const Distance& solids, const Vec3d& place, double apart,
               double h) {
  const double away = solids(place);
  if (away > apart) return false;
  const Vec3d normal = normalAt(body, place, 0.01 * h);
  if (std::abs(normal.dot(normalAt(solids, place, 0.01 * h))) < kParallel) return false;
  return away >= -apart || !comesOut(body, solids, place, normal, h);
}

// Whether the way along an axis leads into a solid and out of it again.
bool leadsThroughWall(const Distance& solids, const Vec3d& from, int axis, double length, double h) {
  bool wasOpen = solids(from) > 0.0, entered = false;
  const double part = std::copysign(h / kParts, length);
  for (double gone = part; std::abs(gone) < std::abs(length); gone += part) {
    Vec3d x = from;
    x[axis] += gone;
    const bool isOpen = solids(x) > 0.0;
    if (isOpen && entered) return true;
    entered = entered || (wasOpen && !isOpen);
    wasOpen = isOpen;
  }
  return false;
}

// Of a plane from how far away it crosses the axes; 0 where it crosses none within kReach cells.
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
      for (int n = 0; n < kReach * kParts; ++n) {
        Vec3d beside = from;
        beside[axis] += part;
        if ((body(beside) < 0.0) == (here < 0.0)) {
          from = beside;
          continue;
        }
        const Vec3d place = crossing(body, from, beside, here);
        const double length = place[axis] - x[axis];
        if (std::abs(length) < nearest && !isAtSolid(body, solids, place, apart, h) &&
            !leadsThroughWall(solids, x, axis, length, h))
          nearest = std::abs(length);
        break;
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
    // As near to two surfaces, along the slope of the distance lies neither.
    const bool isOn = std::abs(body(closest)) < touching;
    if (place == x && isOn && !isAtSolid(body, solids, closest, touching, h)) return here;
    if (const double across = distanceAcross(body, solids, place, here, h); across > 0.0)
      return here < 0.0 ? -across : across;
    // What the body ends at is the solid; its surface is farther away.
    return here < 0.0 ? std::min(here, -kNear * h) : here;
  };
}

}  // namespace fluidtex::sim
