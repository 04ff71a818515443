// How thin solids are, and what is said of those that cells cannot hold.
#include "sim/normal.h"
#include "sim/solids.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace fluidtex::sim {
namespace {

// A wall thinner than this many cells may be missed (see solid_field.cpp).
constexpr double kHolds = 0.6;
// How finely a wall's thickness is looked for, and how far beside a place it has to be as thin, in cells.
constexpr double kStep = 0.05, kBeside = 1.5;

using Distance = std::function<double(const Vec3d&)>;

// The corners of the domain's cells that a solid within these cells can hold; of one without an end, some.
CoordBBox cornersOf(const Coord& cells, const CoordBBox& domain, const CoordBBox& within) {
  constexpr int kSome = 16;
  if (within.empty()) return {};
  CoordBBox corners;
  for (int a = 0; a < 3; ++a) {
    const int first = within.min()[a], last = within.max()[a];
    const bool begins = first > -kEndless, ends = last < kEndless - 1;
    const int low = begins ? first - 1 : std::min(0, ends ? last - kSome : 0);
    const int high = ends ? last + 2 : std::max(cells[a], begins ? first + kSome : 0);
    corners.min()[a] = std::max(low, domain.min()[a]);
    corners.max()[a] = std::min(high, domain.max()[a] + 1);
  }
  return corners;
}

// From the surface near x straight into the solid to its other side, in metres; kForever where that is
// farther than walls that hold are thick, or where no surface is near.
struct ThinPlace {
  double thickness = kForever;
  Vec3d place{0.0}, normal{0.0};
};
ThinPlace wallAt(const Distance& distance, const Vec3d& x, double h) {
  const double d = distance(x);
  if (std::abs(d) > h) return {};
  const Vec3d normal = normalAt(distance, x, 0.02 * h), place = x - d * normal;
  if (normal.length() == 0.0 || std::abs(distance(place)) > 0.1 * h) return {};
  if (distance(place - kHolds * h * normal) < 0.0) return {};
  for (double way = kStep * h; way <= kHolds * h; way += kStep * h)
    if (distance(place - way * normal) > 0.0) return {way, place, normal};
  return {};
}

// Whether the wall goes on beside the place on at least three of four sides: else it is an edge that runs
// out, or a rod, and nothing would pass through it that does not go around it.
bool goesOn(const Distance& distance, const ThinPlace& wall, double h) {
  Vec3d along(0.0);
  along[std::abs(wall.normal[0]) < 0.6 ? 0 : 1] = 1.0;
  const Vec3d p = wall.normal.cross(along).unit(), q = wall.normal.cross(p);
  int count = 0;
  for (const Vec3d& beside : {p, -p, q, -q})
    count += wallAt(distance, wall.place + kBeside * h * beside, h).thickness < kForever;
  return count >= 3;
}

}  // namespace

// Whether any of the solid's surface is among the cells, and its thinnest wall there.
Solids::Thinness Solids::thinnest(const Placed& solid) const {
  const double h = m_options.voxelSize();
  const CoordBBox corners = cornersOf(cellCount(m_options.size, h), m_domain,
                                      cellsIn(boundsAt(solid.shape.boundsIn(kEverywhere), solid.pose), h));
  Thinness result;
  if (corners.empty()) return result;
  const Distance distance = [&](const Vec3d& x) { return distanceTo(solid, x); };
  // Cubes of cell corners, the upper ones left out.
  const std::function<void(const Coord&, int)> look = [&](const Coord& low, int size) {
    if (!corners.hasOverlap(CoordBBox::createCube(low, size))) return;
    const int half = size / 2;
    const Coord middle = low.offsetBy(half);
    const double depth = -distance(middle.asVec3d() * h);
    if (corners.isInside(middle) && depth > -h) result.there = true;
    if (size > 1) {
      if (std::abs(depth) > (0.5 * std::sqrt(3.0) * size + 1.0) * h) return;
      for (int n = 0; n < 8; ++n)
        look(low.offsetBy((n & 1) * half, (n >> 1 & 1) * half, (n >> 2) * half), half);
      return;
    }
    if (std::abs(depth) > h || !corners.isInside(middle)) return;
    const ThinPlace wall = wallAt(distance, middle.asVec3d() * h, h);
    if (wall.thickness >= result.thickness || !goesOn(distance, wall, h)) return;
    result.thickness = wall.thickness;
    result.place = wall.place;
  };
  int size = 1;
  while (size <= corners.extents()[corners.maxExtent()]) size *= 2;
  look(corners.min(), size);
  return result;
}

std::vector<std::string> Solids::warnings() const {
  std::vector<std::string> warnings;
  const double h = m_options.voxelSize();
  for (std::size_t i = 0; i < m_options.solids.size(); ++i) {
    const Solid& solid = m_options.solids[i];
    // One that moves may come in later.
    Thinness all = thinnest(placed(i, solid.from));
    for (const Keyframe& key : solid.keyframes) {
      const Thinness then = thinnest(placed(i, key.time));
      all.there = all.there || then.there;
      if (then.thickness < all.thickness) {
        all.thickness = then.thickness;
        all.place = then.place;
      }
    }
    std::ostringstream text;
    text << "solid " << (solid.name.empty() ? std::to_string(i) : "\"" + solid.name + "\"");
    if (!all.there) {
      text << " is nowhere in the domain, or so thin that no cell of " << h << " m can tell";
    } else if (all.thickness < kForever) {
      const int holds = static_cast<int>(std::ceil(m_options.resolution * kHolds * h / all.thickness));
      text << " is only about " << all.thickness << " m thick at (" << all.place[0] << ", " << all.place[1]
           << ", " << all.place[2] << "), less than 0.6 cells of " << h
           << " m: liquid may pass through it; make it thicker, or give domain.resolution = " << holds;
    } else {
      continue;
    }
    warnings.push_back(text.str());
  }
  return warnings;
}

}  // namespace fluidtex::sim
