// Thickness of solids, and warnings about walls too thin for the cells.
#include "sim/grid/normal.h"
#include "sim/solids/solids.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace fluidtex::sim {
namespace {

// A wall thinner than this many cells may be missed (see open_faces.cpp).
constexpr double kHolds = 0.6;
// In cells: step of the search for a wall's other side, accuracy of its thickness, distance beside a place at
// which it must be thin too, and largest error of the surface's place.
constexpr double kStep = 0.05, kKnown = 1e-3, kBeside = 1.5, kNear = 0.1;

// Files of a mesh sequence that are checked besides the first.
constexpr int kSomeFiles = 8;

using Distance = std::function<double(const Vec3d&)>;

// The corners of the domain's cells that a solid within these cells can hold; for an unbounded solid, some of
// them.
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

// The thickness of the wall at the surface near x, along its normal, in metres; kForever for walls thick
// enough to hold liquid, or where no surface is near.
struct ThinPlace {
  double thickness = kForever;
  Vec3d place{0.0}, normal{0.0};
};
ThinPlace wallAt(const Distance& distance, const Vec3d& x, double h) {
  const double d = distance(x);
  // A place deeper than this is in no thin wall.
  if (std::abs(d) > h || d < -0.5 * kHolds * h) return {};
  const Vec3d normal = normalAt(distance, x, 0.02 * h), near = x - d * normal;
  const double off = distance(near);
  if (normal.length() == 0.0 || std::abs(off) > kNear * h) return {};
  // Beside an edge, the distance of a difference of shapes may lead past the solid.
  const Vec3d place = near - off * normal;
  const auto under = [&](double way) { return distance(place - way * normal); };
  if (under(kKnown * h) >= 0.0 || under(0.5 * kHolds * h) <= -(0.5 * kHolds - kKnown) * h) return {};
  double within = kKnown * h;
  for (double way = within; way <= kHolds * h;) {
    const double there = under(way);
    if (there < 0.0) {
      within = way;
      way += std::max(-there, kStep * h);
      continue;
    }
    while (way - within > kKnown * h) {
      const double middle = 0.5 * (way + within);
      (under(middle) < 0.0 ? within : way) = middle;
    }
    return {way, place, normal};
  }
  return {};
}

// Whether the wall continues beside the place on at least three of four sides. Otherwise it is an edge that
// tapers, or a rod, and liquid passes around it anyway.
bool goesOn(const Distance& distance, const ThinPlace& wall, double h) {
  Vec3d along(0.0);
  along[std::abs(wall.normal[0]) < 0.6 ? 0 : 1] = 1.0;
  const Vec3d p = wall.normal.cross(along).unit(), q = wall.normal.cross(p);
  int count = 0;
  for (const Vec3d& beside : {p, -p, q, -q})
    count += wallAt(distance, wall.place + kBeside * h * beside, h).thickness < kForever;
  return count >= 3;
}

// Calls body(low) for cubes of `least` corners a side, without the upper ones, within a cell of the surface,
// in a cube of `size`. there: set where a corner is in the solid, or within a cell of it.
template <class Body>
void forCubesAtSurface(const Distance& distance, const CoordBBox& corners, double h, const Coord& low,
                       int size, int least, bool& there, const Body& body) {
  if (!corners.hasOverlap(CoordBBox::createCube(low, size))) return;
  const int half = size / 2;
  const Coord middle = low.offsetBy(half);
  const double depth = -distance(middle.asVec3d() * h);
  if (corners.isInside(middle) && depth > -h) there = true;
  const double reach = size > 1 ? 0.5 * std::sqrt(3.0) * size : 0.0;
  if (std::abs(depth) > (reach + 1.0) * h) return;
  if (size == least) return body(low);
  for (int n = 0; n < 8; ++n)
    forCubesAtSurface(distance, corners, h,
                      low.offsetBy((n & 1) * half, (n >> 1 & 1) * half, (n >> 2) * half), half, least, there,
                      body);
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
  constexpr int kBlock = 16;
  int size = kBlock;
  while (size <= corners.extents()[corners.maxExtent()]) size *= 2;
  std::vector<Coord> blocks;
  const auto add = [&](const Coord& low) { blocks.push_back(low); };
  forCubesAtSurface(distance, corners, h, corners.min(), size, kBlock, result.there, add);
  std::vector<Thinness> found(blocks.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t n) {
    Thinness& here = found[n];
    forCubesAtSurface(distance, corners, h, blocks[n], kBlock, 1, here.there, [&](const Coord& corner) {
      const ThinPlace wall = wallAt(distance, corner.asVec3d() * h, h);
      if (wall.thickness >= here.thickness || !goesOn(distance, wall, h)) return;
      here.thickness = wall.thickness;
      here.place = wall.place;
    });
  });
  for (const Thinness& here : found) {
    result.there = result.there || here.there;
    if (here.thickness >= result.thickness) continue;
    result.thickness = here.thickness;
    result.place = here.place;
  }
  return result;
}

std::vector<std::string> Solids::warnings() const {
  std::vector<std::string> warnings;
  const double h = m_options.voxelSize();
  for (std::size_t i = 0; i < m_options.solids.size(); ++i) {
    const Solid& solid = m_options.solids[i];
    // A solid that moves may enter the domain later, and one that changes its shape may become thin.
    std::vector<double> times{solid.from};
    for (const Keyframe& key : solid.keyframes) times.push_back(key.time);
    if (const auto* sequence = std::get_if<MeshSequence>(&solid.shape.kind)) {
      const int last = sequence->count() - 1, some = std::min(last, kSomeFiles);
      for (int n = 1; n <= some; ++n) {
        const double time = sequence->timeOf(n * last / some);
        if (time > solid.from && time < solid.until) times.push_back(time);
      }
    }
    Thinness all;
    for (const double time : times) {
      const Thinness then = thinnest(placed(i, time));
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
