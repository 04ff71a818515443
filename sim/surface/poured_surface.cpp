#include "sim/surface/poured_surface.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/normal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace fluidtex::sim {
namespace {

// kNear: a surface farther away lies between no two cells. kTouching: a body this near a solid touches it. In
// cells.
constexpr double kNear = 1.8, kTouching = 0.05;
// Cells along an axis in which a surface is searched for, and the parts into which each is split.
constexpr int kReach = 2, kParts = 4;
// Cosine of the angle above which two surfaces count as parallel.
constexpr double kParallel = 0.99;
// Distances, in cells, at which a body's surface that is parallel to that of the solid it lies in is searched
// for outside.
constexpr double kAround[] = {2.0, 5.0, 12.0};
// The same, where a solid that the surface lies on has an edge.
constexpr double kBesideEdge = 2.0 * kTouching;
// Cosine of the angle up to which it may have turned there. A sphere that stays within half a cell of its
// tangent plane over two cells turns by 28 degrees; beyond an edge of the body the normal is another one.
constexpr double kTurned = 0.88;
// Widths, in cells, over which a body's normal is taken; the smaller ones beside an edge.
constexpr double kLeastWidth = 1e-4, kMostWidth = 0.01;
// Cells: what is no farther outside lies in a joint, by rounding, and liquid this far behind a surface covers
// it.
constexpr double kOnJoint = 0.01, kBeyond = 0.5;
// Cells: what places and distances may be wrong by.
constexpr double kRounding = 1e-6;
// Bisection steps between two cells.
constexpr int kHalvings = 40;

using Distance = std::function<double(const Vec3d&)>;

// The body's distance. Where parts of it touch, a joint between them is no surface: on two opposite sides it
// is deeper in the liquid.
double withoutJoints(const Distance& body, const Vec3d& x, double h) {
  const double here = body(x), step = kTouching * h;
  if (std::abs(here) > kOnJoint * h) return here;
  const auto isDeeper = [&](const Vec3d& at) { return body(at) < here - 0.2 * step; };
  for (int n = 0; n < 13; ++n) {
    const Vec3d way = step * Coord(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1).asVec3d();
    if (isDeeper(x + way) && isDeeper(x - way)) return -step;
  }
  return here;
}

// Whether the surface that is nearest to a place in the liquid, along the normal there, lies in other liquid:
// in a joint, or in what another part of the body covers.
bool isCovered(const Distance& body, const Vec3d& x, double here, const Vec3d& normal, double h) {
  return here < 0.0 && body(x + (kBeyond * h - here) * normal) < 0.0;
}

// The place between `from` and `to` where a distance changes its sign, by bisection. low: the distance at
// `from`.
Vec3d crossing(const Distance& distance, Vec3d from, Vec3d to, double low) {
  for (int n = 0; n < kHalvings; ++n) {
    const Vec3d middle = 0.5 * (from + to);
    ((distance(middle) < 0.0) == (low < 0.0) ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

// Whether the body's surface is outside solids so many cells from a place on it. normal: of the surface
// there.
bool isOpenAround(const Distance& body, const Distance& solids, const Vec3d& place, const Vec3d& normal,
                  double cells, double h) {
  int least = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(normal[a]) < std::abs(normal[least])) least = a;
  Vec3d axis(0.0);
  axis[least] = 1.0;
  const Vec3d one = normal.cross(axis).unit(), other = normal.cross(one);
  for (const Vec3d& way : {one, -one, other, -other}) {
    const Vec3d there = place + cells * h * way;
    if (std::abs(body(there)) < 0.5 * h && solids(there) > kTouching * h &&
        normal.dot(normalAt(body, there, 0.01 * h)) > kTurned)
      return true;
  }
  return false;
}

// Whether the solids' surface is parallel to one with this normal: their distance changes by the length of
// the step. On one side only in the middle of a wall, where their distance has no gradient.
bool isParallel(const Distance& solids, const Vec3d& place, const Vec3d& normal, double h) {
  const double step = 0.01 * h, here = solids(place);
  return std::max(std::abs(solids(place + step * normal) - here),
                  std::abs(solids(place - step * normal) - here)) >= kParallel * step;
}

// Whether a body ends at a solid at a place on its surface: there the two surfaces coincide, also on all
// sides of the place, or the body reaches some way into the solid. Where one cuts the other, the body's
// surface continues into the solid.
// edge: how near the place may be to an edge of the body; the normal is taken from less far.
bool isAtSolid(const Distance& body, const Distance& solids, const Vec3d& place, double apart, double edge,
               double h) {
  const double away = solids(place);
  if (away > apart) return false;
  const Vec3d normal = normalAt(body, place, std::clamp(0.5 * edge, kLeastWidth * h, kMostWidth * h));
  const auto isOpen = [&](double cells) { return isOpenAround(body, solids, place, normal, cells, h); };
  if (away >= -apart) return isParallel(solids, place, normal, h) && !isOpen(kBesideEdge);
  // Some way into a solid the distance may be that to another one, which stands on the one it ends at.
  return std::none_of(std::begin(kAround), std::end(kAround), isOpen);
}

// Whether a path along an axis enters a solid and leaves it again.
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

// Distance to a plane from where it crosses the axes; 0 where it crosses none within kReach cells.
// off: leads off a solid that x lies on, 0 elsewhere. Each axis is searched beside the solid, where what else
// ends there is not at its edge too.
double distanceAcross(const Distance& body, const Distance& solids, const Vec3d& x, const Vec3d& off,
                      double here, double h) {
  // Where the body ends at a solid, its surface is at no distance from it; a surface beside a solid is as far
  // from it as x.
  const double apart = std::min(kTouching * h, 0.5 * std::abs(solids(x + off)));
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double nearest = kForever;
    Vec3d start = x + off;
    start[axis] = x[axis];
    for (const double part : {-h / kParts, h / kParts}) {
      Vec3d from = start;
      for (int n = 0; n < kReach * kParts; ++n) {
        Vec3d beside = from;
        beside[axis] += part;
        if ((body(beside) < 0.0) == (here < 0.0)) {
          from = beside;
          continue;
        }
        const Vec3d place = crossing(body, from, beside, here);
        const double length = place[axis] - x[axis];
        if (std::abs(length) < nearest && !isAtSolid(body, solids, place, apart, std::abs(here), h) &&
            !leadsThroughWall(solids, start, axis, length, h))
          nearest = std::abs(length);
        break;
      }
    }
    // A surface through the centre itself has a distance of the size of rounding.
    nearest = std::max(nearest, kRounding * h);
    squares += 1.0 / (nearest * nearest);
  }
  return squares > 0.0 ? 1.0 / std::sqrt(squares) : 0.0;
}

}  // namespace

Distance pouredSurface(Distance parts, Distance solids, double h) {
  const Distance body = [parts = std::move(parts), h](const Vec3d& x) { return withoutJoints(parts, x, h); };
  return [body, solids = std::move(solids), h](const Vec3d& x) {
    double here = body(x);
    const double touching = kTouching * h;
    if (std::abs(here) > kNear * h) return here;
    const Vec3d outwards = normalAt(body, x, 0.01 * h);
    const bool covered = isCovered(body, x, here, outwards, h);
    const double room = solids(x);
    if (room > std::abs(here) + touching && !covered) return here;
    // There is no air between a body and a solid that it almost touches. In a corner of several solids, which
    // has no normal, the body shows the way.
    Vec3d place = x, off(0.0);
    if (room > -kRounding * h && room < touching) {
      Vec3d beside = x + touching * normalAt(solids, x, 0.01 * h);
      if (here >= 0.0 && solids(beside) < 0.5 * touching) beside = x - touching * outwards;
      if ((body(beside) < 0.0) != (here < 0.0)) {
        place = beside;
        here = body(place);
      } else if (room < kRounding * h) {
        off = beside - x;
      }
    }
    const Vec3d closest = place - here * normalAt(body, place, 0.01 * h);
    // Where two surfaces are equally near, neither lies along the gradient of the distance.
    const bool isOn = !covered && std::abs(body(closest)) < touching;
    if (place == x && isOn && !isAtSolid(body, solids, closest, touching, h, h)) return here;
    if (const double across = distanceAcross(body, solids, place, off, here, h); across > 0.0)
      return here < 0.0 ? -across : across;
    // The body ends at the solid here; its own surface is farther away.
    return here < 0.0 ? std::min(here, -kNear * h) : here;
  };
}

MaskGrid beyondOwnSurface(const FloatGrid& poured, const FloatGrid& phi, const FloatGrid& solidPhi,
                          const Distance& body, const Distance& solids) {
  const double h = phi.voxelSize()[0];
  const auto leaves = leavesOf(poured.constTree());
  std::vector<std::vector<Coord>> found(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves[n]->origin();
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* all = leafValues(phi.constTree(), origin, phiScratch);
    const float* depth = leafValues(solidPhi.constTree(), origin, solidScratch);
    for (int i = 0; i < kLeafSize; ++i) {
      const float here = leaves[n]->getValue(i);
      if (depth[i] > 0.0f || depth[i] <= -h || std::abs(here) > kNear * h || all[i] != here) continue;
      const Coord cell = leaves[n]->offsetToGlobalCoord(i);
      const Vec3d x = phi.indexToWorld(cell);
      const Vec3d closest = x - here * normalAt(body, x, 0.01 * h);
      if (std::abs(body(closest)) < kTouching * h && solids(closest) > kTouching * h)
        found[n].push_back(cell);
    }
  });
  MaskGrid cells;
  for (const auto& part : found)
    for (const Coord& cell : part) cells.tree().setValueOn(cell);
  return cells;
}

MaskGrid clearBehindWalls(FloatGrid& phi, const SolidField& solid, const Distance& body,
                          const Distance& solids) {
  MaskGrid cells;
  if (solid.visibility == nullptr) return cells;
  const double h = phi.voxelSize()[0];
  const std::vector<Coord>& origins = solid.visibility->origins();
  std::vector<std::vector<Coord>> found(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    const Visibility::Leaf& sight = *solid.visibility->leaf(origins[n]);
    const auto liquid = phi.getConstUnsafeAccessor(), distance = solid.phi->getConstUnsafeAccessor();
    float scratch[kLeafSize];
    const float* open = leafValues(solid.phi->constTree(), origins[n], scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      if (open[i] >= 0.0f || open[i] <= -0.5f * static_cast<float>(h) || sight[i].seesAll()) continue;
      const Coord cell = origins[n].offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      bool seen = false, hidden = false;
      for (int at = 0; at < VisibleCells::kCount && !seen; ++at) {
        constexpr int kSide = VisibleCells::kSide, kFar = VisibleCells::kReach;
        const Coord other =
            cell.offsetBy(at / (kSide * kSide) - kFar, at / kSide % kSide - kFar, at % kSide - kFar);
        if (liquid.getValue(other) >= 0.0f || distance.getValue(other) <= 0.0f) continue;
        (sight[i].sees(at) ? seen : hidden) = true;
      }
      if (seen || !hidden) continue;
      const Vec3d x = phi.indexToWorld(cell);
      const Vec3d closest = x - body(x) * normalAt(body, x, 0.01 * h);
      if (solids(closest) < kTouching * h) found[n].push_back(cell);
    }
  });
  FloatGrid::Accessor values = phi.getAccessor();
  for (const auto& part : found) {
    for (const Coord& cell : part) {
      cells.tree().setValueOn(cell);
      values.setValue(cell, std::max(values.getValue(cell), static_cast<float>(0.5 * h)));
    }
  }
  return cells;
}

}  // namespace fluidtex::sim
