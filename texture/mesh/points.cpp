// Dart throwing after Cook, "Stochastic sampling in computer graphics" (1986), on a surface, with a spatial
// hash.
#include "texture/mesh/points.h"

#include "numerics/random.h"
#include "texture/levelset/point_scale.h"
#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"
#include "texture/mesh/patches.h"
#include "texture/mesh/remesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

float unit(std::uint64_t random) {
  return float(random >> 40) * 0x1p-24f;
}

// Points in cells of a given size, chained in a hash table.
class GrowingGrid {
 public:
  GrowingGrid(float cell, std::size_t expected) : m_inverse(1.0f / cell) {
    std::size_t capacity = 64;
    while (capacity < 3 * expected) capacity *= 2;
    m_head.assign(capacity, kNone);
  }
  void insert(const Vec3f& p, std::uint32_t index) {
    std::uint32_t& head = m_head[slot(index3(p.x()), index3(p.y()), index3(p.z()))];
    m_items.push_back({p, index, head});
    head = std::uint32_t(m_items.size() - 1);
  }
  // Whether hit(index) holds for a point closer than the cell size.
  template <class Hit>
  bool anyWithin(const Vec3f& p, float radius, const Hit& hit) const {
    const int x = index3(p.x()), y = index3(p.y()), z = index3(p.z());
    // The point's own cell first: where the surface is covered already, it mostly decides.
    if (cellHas(slot(x, y, z), p, radius, hit)) return true;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          if ((dx | dy | dz) != 0 && cellHas(slot(x + dx, y + dy, z + dz), p, radius, hit)) return true;
        }
      }
    }
    return false;
  }

 private:
  struct Item {
    Vec3f position;
    std::uint32_t index, next;
  };
  int index3(float x) const { return cellAlong(x * m_inverse); }
  std::size_t slot(int x, int y, int z) const { return nearbySlot(x, y, z, m_head.size() - 1); }
  template <class Hit>
  bool cellHas(std::size_t s, const Vec3f& p, float radius, const Hit& hit) const {
    for (std::uint32_t i = m_head[s]; i != kNone; i = m_items[i].next) {
      if ((m_items[i].position - p).lengthSqr() < radius * radius && hit(m_items[i].index)) return true;
    }
    return false;
  }
  float m_inverse;
  std::vector<std::uint32_t> m_head;
  std::vector<Item> m_items;
};

// The points placed so far, for conflict tests. With a varying scale there is one grid per octave of it; the
// scale hardly changes within a point's reach, so the adjacent octaves are enough.
class Placed {
 public:
  Placed(const LevelSet& phi, float radius, std::size_t expected) : m_phi(phi) {
    if (!phi.scaled()) {
      m_grids.emplace_back(radius, expected);
      return;
    }
    for (double scale = kLeastScale; scale < 2.0 * kLargestScale; scale *= 2.0)
      m_grids.emplace_back(radius * float(scale), expected);
  }
  // radius: at scale 1; the smaller scale of two points counts.
  bool near(const Vec3f& p, const Vec3f& n, float radius) const {
    constexpr float kSameSide =
        -0.3f;  // cosine of normals: across a right-angled crease points still see each other
    if (!m_phi.scaled())
      return m_grids[0].anyWithin(p, radius,
                                  [&](std::uint32_t i) { return points.normal[i].dot(n) > kSameSide; });
    const float scale = m_phi.scale(p);
    const std::size_t own = octave(scale);
    for (std::size_t k = own - std::min<std::size_t>(own, 1); k < std::min(own + 2, m_grids.size()); ++k) {
      if (m_grids[k].anyWithin(p, radius * scale, [&](std::uint32_t i) {
            const float reach = radius * m_scale[i];
            return points.normal[i].dot(n) > kSameSide &&
                   (points.position[i] - p).lengthSqr() < reach * reach;
          }))
        return true;
    }
    return false;
  }
  void place(const Vec3f& p, const Vec3f& n, float radius) {
    if (!near(p, n, radius)) add(p, n);
  }
  void add(const Vec3f& p, const Vec3f& n) {
    const float scale = m_phi.scale(p);
    if (m_phi.scaled()) m_scale.push_back(scale);
    m_grids[m_phi.scaled() ? octave(scale) : 0].insert(p, std::uint32_t(points.position.size()));
    points.position.push_back(p);
    points.normal.push_back(n);
  }

  PointSet points;

 private:
  static std::size_t octave(float scale) {
    std::size_t k = 0;
    for (double most = kLeastScale; scale > most && most < kLargestScale; most *= 2.0) ++k;
    return k;
  }

  const LevelSet& m_phi;
  std::vector<GrowingGrid> m_grids;
  std::vector<float> m_scale;  // #P where it varies
};

// Places points cube by cube, in parallel: offersOf(cube, offer) calls offer(position, normal) for the
// candidates of a cube. A candidate is placed unless it conflicts with a point placed before, or offered
// earlier. First the interiors of all cubes, then what lies between them.
template <class OffersOf>
void placeAll(const LevelSet& phi, const Patches& cubes, float side, float radius, std::size_t expected,
              const OffersOf& offersOf, Placed& placed) {
  struct Part {
    PointSet deep, between;
  };
  std::vector<Part> parts(cubes.count());
  const bool first = placed.points.position.empty();
  forEachPatch(cubes, [&](std::uint32_t cube) {
    Placed inside(phi, radius, expected);
    PointSet& between = parts[cube].between;
    offersOf(cube, [&](const Vec3f& p, const Vec3f& n) {
      if (!first && placed.near(p, n, radius)) return;
      const float reach = radius * phi.scale(p);
      bool deep = true;
      for (int axis = 0; axis < 3; ++axis) {
        const float at = p[axis] - side * std::floor(p[axis] / side);
        deep = deep && at > reach && at < side - reach;
      }
      if (deep) {
        inside.place(p, n, radius);
      } else {
        between.position.push_back(p);
        between.normal.push_back(n);
      }
    });
    parts[cube].deep = std::move(inside.points);
  });
  for (const Part& part : parts)
    for (std::size_t k = 0; k < part.deep.position.size(); ++k)
      placed.add(part.deep.position[k], part.deep.normal[k]);
  for (const Part& part : parts)
    for (std::size_t k = 0; k < part.between.position.size(); ++k)
      placed.place(part.between.position[k], part.between.normal[k], radius);
}

// Calls offer(position, normal) for random points of triangle t, keyed by its cell and its index there.
template <class Offer>
void throwDarts(const LevelSet& phi, const IsoSurface& surface, std::size_t t, std::uint64_t key,
                float perArea, const Offer& offer) {
  const openvdb::Coord& cell = surface.cells[t];
  std::uint64_t ordinal = 0;
  while (ordinal < t && surface.cells[t - std::size_t(ordinal) - 1] == cell) ++ordinal;
  std::uint64_t triangleKey = key;
  for (int axis = 0; axis < 3; ++axis) triangleKey = randomBits(triangleKey, std::uint32_t(cell[axis]));
  triangleKey = randomBits(triangleKey, ordinal);
  const Vec3f& a = surface.positions[surface.triangles[t][0]];
  const Vec3f ab = surface.positions[surface.triangles[t][1]] - a,
              ac = surface.positions[surface.triangles[t][2]] - a;
  const Vec3f normal = ab.cross(ac);
  const float length = normal.length();
  const float scale = phi.scale(a);
  const int darts = int(0.5f * length * perArea / (scale * scale) + unit(triangleKey));
  for (int d = 0; d < darts; ++d) {
    const std::uint64_t random = randomBits(triangleKey, std::uint64_t(d));
    const float r = std::sqrt(unit(random)), s = unit(random << 24);
    offer(a + ab * (r * (1.0f - s)) + ac * (r * s), normal / length);
  }
}

}  // namespace

PointSet spreadPoints(const LevelSet& phi, const IsoSurface& surface, const std::vector<Vec3f>& seeds,
                      float spacing, std::uint64_t key) {
  // Seeds of a uniform set are never this near each other, so a liquid at rest loses none.
  constexpr float kSeedDistance = 0.5f;
  // Where points are even already no place on the surface is further than about 0.8 spacings from one.
  constexpr float kDartDistance = 0.8f, kFillDistance = 0.95f;
  // Between seeds there are few gaps, and long edges are split later.
  const float dartsPerPoint = seeds.empty() ? 5.0f : 2.0f;
  constexpr float kCube = 40.0f;     // spacings: the side of what one thread works on
  constexpr float kReach = 1.5f;     // voxels from which a seed is still brought back
  constexpr float kSnapped = 0.05f;  // voxels from the surface at most, after projection
  constexpr float kStill = 1e-3f;    // voxels: a seed this near stays exactly where it is

  const float dartRadius = (seeds.empty() ? kDartDistance : kFillDistance) * spacing;
  const std::size_t expected = std::size_t(squares(phi, surface) / (double(spacing) * spacing));
  Placed placed(phi, dartRadius, expected);
  PointSet& points = placed.points;
  points.position.reserve(expected + expected / 8 + 16);
  points.normal.reserve(points.position.capacity());

  std::vector<LevelSet::Projection> projected(seeds.size());
  forEachIndex(seeds.size(), [&](std::uint32_t i) {
    if (!std::isfinite(seeds[i].lengthSqr())) return;
    projected[i] = phi.project(seeds[i], kReach);
    if ((projected[i].position - seeds[i]).lengthSqr() < kStill * kStill) projected[i].position = seeds[i];
  });
  // Whole voxels, so that a cell's triangles lie in one cube.
  const float side = std::ceil(kCube * spacing);
  std::vector<Vec3f> places;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < projected.size(); ++i) {
    if (!projected[i].known || projected[i].distance >= kSnapped) continue;
    places.push_back(projected[i].position);
    kept.push_back(i);
  }
  const auto perCube = std::size_t(kCube * kCube);
  if (!kept.empty()) {
    const Patches cubes = patchesOf(places, side);
    const auto seedsOf = [&](std::uint32_t cube, const auto& offer) {
      for (std::uint32_t k = cubes.first[cube]; k < cubes.first[cube + 1]; ++k) {
        const LevelSet::Projection& p = projected[kept[cubes.vertex[k]]];
        offer(p.position, p.normal);
      }
    };
    placeAll(phi, cubes, side, kSeedDistance * spacing, perCube, seedsOf, placed);
  }

  const float perArea = dartsPerPoint / (spacing * spacing);
  places.resize(surface.triangles.size());
  forEachIndex(places.size(), [&](std::uint32_t t) { places[t] = surface.cells[t].asVec3s() + Vec3f(0.5f); });
  const Patches cubes = patchesOf(places, side);
  const auto dartsOf = [&](std::uint32_t cube, const auto& offer) {
    for (std::uint32_t k = cubes.first[cube]; k < cubes.first[cube + 1]; ++k)
      throwDarts(phi, surface, cubes.vertex[k], key, perArea, offer);
  };
  const std::size_t seeded = points.position.size();
  placeAll(phi, cubes, side, dartRadius, perCube, dartsOf, placed);
  // Darts lie on the trilinear surface. Where it is farther from the smooth one than they are from each
  // other, they could not get there one by one.
  forEachIndex(points.position.size() - seeded, [&](std::uint32_t k) {
    const std::size_t i = seeded + k;
    const LevelSet::Projection p = phi.project(points.position[i], reachFor(spacing));
    if (!p.known || p.distance >= kSnapped || p.normal.dot(points.normal[i]) <= 0.0f) return;
    points.position[i] = p.position;
    points.normal[i] = p.normal;
  });
  return std::move(points);
}

}  // namespace fluidtex::texture
