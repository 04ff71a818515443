#include "caches/liquid/cell_triangles.h"

#include "sim/grid/mac_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

constexpr double kFarthest = 1e9;  // cells

// The first of the points that are in the same place, for each. By a table with open addressing.
std::vector<std::uint32_t> firstInPlace(const std::vector<Vec3f>& points) {
  constexpr std::uint32_t kFree = ~0u;
  const std::size_t mask = std::bit_ceil(2 * points.size() + 1) - 1;
  std::vector<std::uint32_t> table(mask + 1, kFree), first(points.size());
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
      hash = (hash ^ std::bit_cast<std::uint32_t>(points[n][axis])) * 0x9e3779b97f4a7c15ull;
    std::size_t at = (hash >> 32) & mask;
    while (table[at] != kFree && !(points[table[at]] == points[n])) at = (at + 1) & mask;
    if (table[at] == kFree) table[at] = n;
    first[n] = table[at];
  }
  return first;
}

// Those that are so low touch no more than what their neighbours do.
bool isFlat(const CellTriangles& surface, const Vec3I& t) {
  const Vec3d a(surface.points[t[0]]), ab = Vec3d(surface.points[t[1]]) - a,
                                       ac = Vec3d(surface.points[t[2]]) - a;
  const double longest = std::sqrt(std::max({ab.lengthSqr(), ac.lengthSqr(), (ac - ab).lengthSqr()}));
  return !(ab.cross(ac).length() > kTouch * longest);  // nor is it where one is no number
}

void findRings(CellTriangles& surface) {
  const auto forCorners = [&](const auto& visit) {
    for (std::uint32_t n = 0; n < surface.triangles.size(); ++n)
      if (surface.counts(n))
        for (int corner = 0; corner < 3; ++corner) visit(n, surface.triangles[n][corner]);
  };
  surface.ringFirst.assign(surface.points.size() + 1, 0);
  forCorners([&](std::uint32_t, std::uint32_t point) { ++surface.ringFirst[point + 1]; });
  for (std::size_t p = 0; p < surface.points.size(); ++p) surface.ringFirst[p + 1] += surface.ringFirst[p];
  surface.ring.resize(surface.ringFirst.back());
  std::vector<std::uint32_t> next(surface.ringFirst.begin(), surface.ringFirst.end() - 1);
  forCorners([&](std::uint32_t n, std::uint32_t point) { surface.ring[next[point]++] = n; });
}

// The triangle across the edge or around the corner that the closest point lies on, where one comes nearer.
// at: the closest point of `triangle`; replaced.
bool stepNearer(const CellTriangles& surface, const Vec3d& place, std::uint32_t& triangle,
                TrianglePoint& at) {
  const Vec3I& corners = surface.triangles[triangle];
  int zeros = 0, on = 0;  // on: a corner of the feature
  for (int corner = 0; corner < 3; ++corner) {
    if (at.weight[corner] == 0.0)
      ++zeros;
    else
      on = corner;
  }
  if (zeros == 0) return false;
  const std::uint32_t pivot = corners[on];
  std::uint32_t other = pivot;  // the edge's second corner
  if (zeros == 1) other = corners[at.weight[(on + 1) % 3] != 0.0 ? (on + 1) % 3 : (on + 2) % 3];
  bool found = false;
  for (const std::uint32_t next : surface.around(pivot)) {
    if (next == triangle) continue;
    const Vec3I& t = surface.triangles[next];
    if (t[0] != other && t[1] != other && t[2] != other) continue;
    // Only one that turns towards the place can be nearer.
    bool isTowards = false;
    for (int corner = 0; corner < 3 && !isTowards; ++corner)
      isTowards = (Vec3d(surface.points[t[corner]]) - place - at.offset).dot(at.offset) < 0.0;
    if (!isTowards) continue;
    const TrianglePoint there = closestPoint(surface, next, place);
    if (!(there.square < at.square)) continue;
    at = there;
    triangle = next;
    found = true;
    break;
  }
  return found;
}

}  // namespace

CellTriangles cellTriangles(const SurfaceTriangles& surface, double h) {
  CellTriangles result;
  Vec3d low(std::numeric_limits<double>::max()), high(-low);
  for (const Vec3f& x : surface.points) {
    const Vec3d place = Vec3d(x) / h;
    if (!(place.length() < kFarthest)) continue;
    low = openvdb::math::minComponent(low, place);
    high = openvdb::math::maxComponent(high, place);
  }
  if (low[0] <= high[0]) result.origin = sim::leafOrigin(Coord::floor(0.5 * (low + high)));
  const Vec3d shift = result.origin.asVec3d() + Vec3d(0.5);
  result.points.resize(surface.points.size());
  tbb::parallel_for(std::size_t{0}, surface.points.size(), [&](std::size_t n) {
    const Vec3d place = Vec3d(surface.points[n]) / h;
    result.points[n] =
        place.length() < kFarthest ? Vec3f(place - shift) : Vec3f(std::numeric_limits<float>::quiet_NaN());
  });
  result.triangles = surface.triangles;
  // A closed mesh has half as many points as triangles; more than that are corners of each triangle's own.
  if (result.points.size() > result.triangles.size()) {
    const std::vector<std::uint32_t> first = firstInPlace(result.points);
    for (Vec3I& t : result.triangles) t = Vec3I(first[t[0]], first[t[1]], first[t[2]]);
  }
  tbb::parallel_for(std::size_t{0}, result.triangles.size(), [&](std::size_t n) {
    if (Vec3I& t = result.triangles[n]; isFlat(result, t)) t = Vec3I(t[0]);
  });
  findRings(result);
  return result;
}

// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
TrianglePoint closestPoint(const CellTriangles& surface, std::uint32_t triangle, const Vec3d& place) {
  const Vec3I& t = surface.triangles[triangle];
  const Vec3d a = Vec3d(surface.points[t[0]]) - place, b = Vec3d(surface.points[t[1]]) - place,
              c = Vec3d(surface.points[t[2]]) - place;
  const Vec3d ab = b - a, ac = c - a;
  const auto at = [&](double u, double v, double w, const Vec3d& x) {
    return TrianglePoint{x.lengthSqr(), Vec3d(u, v, w), x};
  };
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return at(1.0, 0.0, 0.0, a);
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return at(0.0, 1.0, 0.0, b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) {  // not where a and b are one
    const double v = d1 / (d1 - d3);
    return at(1.0 - v, v, 0.0, a + v * ab);
  }
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return at(0.0, 0.0, 1.0, c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return at(1.0 - w, 0.0, w, a + w * ac);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(0.0, 1.0 - w, w, b + w * (c - b));
  }
  const double scale = 1.0 / (va + vb + vc), v = vb * scale, w = vc * scale;
  return at(1.0 - v - w, v, w, a + v * ab + w * ac);
}

Nearest descend(const CellTriangles& surface, const Vec3d& place, std::uint32_t triangle,
                TrianglePoint closest) {
  while (stepNearer(surface, place, triangle, closest)) {
  }
  return {float(closest.square), triangle};
}

}  // namespace fluidtex::caches
