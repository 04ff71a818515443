#include "tools/stress_scenes/surroundings.h"

#include "sim/solids/domain.h"
#include "sim/solids/open_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::stress {
namespace {

bool staysAsItIs(const sim::Solid& solid) {
  return solid.keyframes.empty() && solid.from <= 0.0 && solid.until == sim::kForever;
}

constexpr int kCellSamples = kSamplesPerCell * kSamplesPerCell * kSamplesPerCell;

// Share of a sample's cube that lies within the surface at that distance.
double share(double distance, double step) {
  return std::clamp(0.5 - distance / step, 0.0, 1.0);
}

// What can set liquid in motion, or hold it in a shape that is not level.
bool disturbs(const sim::Options& options) {
  for (const sim::LiquidBody& body : options.liquid)
    if (body.from > 0.0 || body.velocity != Vec3d(0.0)) return true;
  for (const sim::Solid& solid : options.solids)
    if (!staysAsItIs(solid) || solid.wall.velocity != Vec3d(0.0)) return true;
  for (const sim::DomainWall& wall : options.walls)
    if (wall.wall.velocity != Vec3d(0.0)) return true;
  return !options.sources.empty() || !options.drains.empty() || options.surfaceTension > 0.0;
}

}  // namespace

openvdb::CoordBBox sampledCells(const sim::Options& options) {
  const double h = options.voxelSize();
  const openvdb::CoordBBox inside = sim::firstCells(sim::cellCount(options.size, h));
  const openvdb::BBoxd domain = sim::domainBox(options);
  openvdb::CoordBBox cells = inside, most = inside;
  for (int side = 0; side < 6; ++side) {
    if (options.sides[side] != sim::Side::unbounded) continue;
    const int axis = side / 2, far = inside.dim()[axis];
    side % 2 == 0 ? most.min()[axis] -= far : most.max()[axis] += far;
  }
  const auto add = [&](const sim::Shape& shape) {
    const openvdb::BBoxd bounds = sim::ShapeDistance(shape, h, domain).boundsIn(domain);
    if (bounds) cells.expand(sim::cellsIn(bounds, h));
  };
  for (const sim::LiquidBody& body : options.liquid) add(body.shape);
  for (const sim::Source& source : options.sources) add(source.shape);
  cells.intersect(most);
  return cells;
}

Surroundings::Surroundings(const sim::Options& options, const std::vector<std::size_t>& leaking)
    : m_options(options), m_step(options.voxelSize() / kSamplesPerCell) {
  const openvdb::BBoxd domain = sim::domainBox(options);
  const openvdb::CoordBBox cells = sampledCells(options);
  for (int a = 0; a < 3; ++a) {
    m_first[a] = cells.min()[a] * kSamplesPerCell;
    m_count[a] = cells.dim()[a] * kSamplesPerCell;
  }

  sim::Options tight = options;
  tight.solids.clear();
  for (std::size_t n = 0; n < options.solids.size(); ++n) {
    if (staysAsItIs(options.solids[n]) && std::find(leaking.begin(), leaking.end(), n) == leaking.end())
      tight.solids.push_back(options.solids[n]);
  }
  const sim::Solids held(tight), all(options);
  const std::vector<float> open = distances([&](const Vec3d& x) { return held.distance(x, 0.0); });
  const std::vector<float> openNow = distances([&](const Vec3d& x) { return all.distance(x, 0.0); });

  std::vector<float> ever(open.size(), INFINITY), first(open.size(), INFINITY);
  std::vector<sim::ShapeDistance> shapes;
  const auto add = [&](const sim::Shape& shape, double from) {
    const sim::ShapeDistance& distance = shapes.emplace_back(shape, options.voxelSize(), domain);
    const std::vector<float> body = distances([&](const Vec3d& x) { return distance(x); });
    double highest = -INFINITY;
    for (std::size_t n = 0; n < body.size(); ++n) {
      ever[n] = std::min(ever[n], body[n]);
      if (from <= 0.0) first[n] = std::min(first[n], body[n]);
      if (body[n] < 0.0f && open[n] > 0.0f) highest = std::max(highest, -options.gravity.dot(place(n)));
    }
    m_bodies.push_back({from, highest});
  };
  for (const sim::LiquidBody& body : options.liquid) add(body.shape, body.from);
  for (const sim::Source& source : options.sources) add(source.shape, source.from);

  if (!options.sources.empty()) {
    std::vector<float> taken(ever);
    for (std::size_t n = 0; n < taken.size(); ++n) taken[n] = std::min({taken[n], open[n], openNow[n]});
    for (const sim::Source& source : options.sources) {
      const sim::ShapeDistance distance(source.shape, options.voxelSize(), domain);
      m_rooms.push_back(roomFrom(open, distances([&](const Vec3d& x) { return distance(x); }), taken));
    }
  }

  const double cube = m_step * m_step * m_step;
  for (std::size_t n = 0; n < first.size(); ++n) {
    const double distance = std::max(first[n], -openNow[n]);
    m_poured += share(distance, m_step) * cube;
    if (std::abs(distance) < 0.5 * m_step) m_pouredSurface += m_step * m_step;
  }
  findUnresolved(all, openNow, first);
  const double top = highest(sim::kForever);
  const bool calm = !disturbs(options) && std::isfinite(top);
  const double weight = options.gravity.length();
  // Of a body that reaches out of a wall by less, no sample knows.
  const double near = 0.5 * m_step;
  m_flood = flood(open, ever, calm ? top + weight * options.voxelSize() : INFINITY, calm ? 0.0 : near);
  if (!calm) return;
  const auto toLiquid = [&](const Vec3d& x) {
    double distance = INFINITY;
    for (const sim::ShapeDistance& shape : shapes) distance = std::min(distance, shape(x));
    return distance;
  };
  m_atRest = !m_flood.unbounded && isFilled(open, ever, toLiquid, top - 1.01 * weight * m_step);
  for (int side = 0; side < 6 && m_atRest; ++side) {
    if (sim::isClosed(options.sides[side])) continue;
    const int axis = side / 2, end = side % 2 == 0 ? 0 : m_count[axis] - 1;
    for (std::size_t n = 0; n < ever.size(); ++n) {
      const Coord at(static_cast<int>(n) / (m_count[1] * m_count[2]),
                     static_cast<int>(n) / m_count[2] % m_count[1], static_cast<int>(n) % m_count[2]);
      if (at[axis] == end && m_flood.reached[n] != 0) m_atRest = false;
    }
  }
  if (!m_atRest) m_flood = flood(open, ever, INFINITY, near);
}

Vec3d Surroundings::place(std::size_t sample) const {
  const int n = static_cast<int>(sample);
  const openvdb::Coord cell(n / (m_count[1] * m_count[2]), n / m_count[2] % m_count[1], n % m_count[2]);
  return ((m_first + cell).asVec3d() + Vec3d(0.5)) * m_step;
}

std::vector<float> Surroundings::distances(const std::function<double(const Vec3d&)>& distance) const {
  std::vector<float> values(static_cast<std::size_t>(m_count[0]) * m_count[1] * m_count[2]);
  tbb::parallel_for(std::size_t{0}, values.size(),
                    [&](std::size_t n) { values[n] = static_cast<float>(distance(place(n))); });
  return values;
}

// open, liquid: distances at the samples.
void Surroundings::findUnresolved(const sim::Solids& solids, const std::vector<float>& open,
                                  const std::vector<float>& liquid) {
  const double h = m_options.voxelSize(), cube = m_step * m_step * m_step;
  const std::size_t stride[3] = {static_cast<std::size_t>(m_count[1]) * m_count[2],
                                 static_cast<std::size_t>(m_count[2]), 1};
  const auto hasOpenCorner = [&](const Coord& cell) {
    for (int n = 0; n < 8; ++n)
      if (solids.distance((cell.asVec3d() + Vec3d(n & 1, n >> 1 & 1, n >> 2)) * h, 0.0) > sim::kOnWall * h)
        return true;
    return false;
  };
  // Whether the solid at a sample ends within a cell, from side to side, and there is liquid on one of them.
  const auto isThinWall = [&](const Coord& at, std::size_t n) {
    for (int a = 0; a < 3; ++a) {
      int away[2] = {0, 0};
      bool wet = false;
      for (int side = 0; side < 2; ++side) {
        for (int steps = 1; steps <= kSamplesPerCell && away[side] == 0; ++steps) {
          const int place = at[a] + (side == 0 ? -steps : steps);
          if (place < 0 || place >= m_count[a]) break;
          const std::size_t there = side == 0 ? n - steps * stride[a] : n + steps * stride[a];
          if (open[there] <= 0.0f) continue;
          away[side] = steps;
          wet = wet || liquid[there] < 0.0f;
        }
      }
      if (wet && away[0] > 0 && away[1] > 0 && away[0] + away[1] <= kSamplesPerCell + 1) return true;
    }
    return false;
  };
  for (int cell = 0; cell < m_count[0] * m_count[1] * m_count[2] / kCellSamples; ++cell) {
    const Coord cells(m_count[0] / kSamplesPerCell, m_count[1] / kSamplesPerCell,
                      m_count[2] / kSamplesPerCell);
    const Coord at(cell / (cells[1] * cells[2]), cell / cells[2] % cells[1], cell % cells[2]);
    const Coord first(m_first[0] / kSamplesPerCell, m_first[1] / kSamplesPerCell,
                      m_first[2] / kSamplesPerCell);
    double wet = 0.0;
    bool cut = false, thin = false;
    for (int n = 0; n < kCellSamples; ++n) {
      const Coord sample(at[0] * kSamplesPerCell + n / (kSamplesPerCell * kSamplesPerCell),
                         at[1] * kSamplesPerCell + n / kSamplesPerCell % kSamplesPerCell,
                         at[2] * kSamplesPerCell + n % kSamplesPerCell);
      const std::size_t index = sample[0] * stride[0] + sample[1] * stride[1] + sample[2];
      wet += share(std::max(liquid[index], -open[index]), m_step);
      cut = cut || open[index] <= static_cast<float>(h);
      thin = thin || (open[index] <= 0.0f && isThinWall(sample, index));
    }
    if (wet > 0.0 && cut && !hasOpenCorner(first + at)) {
      m_inNarrowGaps += wet * cube;
    } else if (thin) {
      m_besideThinWalls += 0.5 * h * h * h;
    }
  }
}

// highest: no place with more of -gravity . x is entered. near: metres; places this near to liquid count as
// liquid.
Surroundings::Flood Surroundings::flood(const std::vector<float>& open, const std::vector<float>& liquid,
                                        double highest, double near) const {
  Flood found{std::vector<std::uint8_t>(open.size(), 0)};
  std::vector<std::size_t> front;
  const auto enter = [&](std::size_t n) {
    if (found.reached[n] != 0 || open[n] <= 0.0f || -m_options.gravity.dot(place(n)) > highest) return;
    found.reached[n] = 1;
    front.push_back(n);
  };
  for (std::size_t n = 0; n < open.size(); ++n)
    if (liquid[n] < near) enter(n);
  const std::size_t stride[3] = {static_cast<std::size_t>(m_count[1]) * m_count[2],
                                 static_cast<std::size_t>(m_count[2]), 1};
  // What is behind one unbounded side is behind all of them.
  const auto enterFromOutside = [&] {
    found.unbounded = true;
    for (std::size_t n = 0; n < open.size(); ++n) {
      for (int side = 0; side < 6; ++side) {
        const int a = side / 2, at = static_cast<int>(n / stride[a]) % m_count[a];
        if (m_options.sides[side] == sim::Side::unbounded && at == (side % 2 == 0 ? 0 : m_count[a] - 1))
          enter(n);
      }
    }
  };
  while (!front.empty()) {
    const std::size_t n = front.back();
    front.pop_back();
    for (int side = 0; side < 6; ++side) {
      const int a = side / 2, at = static_cast<int>(n / stride[a]) % m_count[a];
      if (at == (side % 2 == 0 ? 0 : m_count[a] - 1)) {
        if (m_options.sides[side] == sim::Side::unbounded && !found.unbounded) enterFromOutside();
        continue;
      }
      enter(side % 2 == 0 ? n - stride[a] : n + stride[a]);
    }
  }
  return found;
}

// open, liquid: distances at the samples; toLiquid: at any place. Below `highest` (of -gravity . x).
bool Surroundings::isFilled(const std::vector<float>& open, const std::vector<float>& liquid,
                            const std::function<double(const Vec3d&)>& toLiquid, double highest) const {
  // Less than this between liquid and a wall moves nothing.
  const double least = sim::kOnWall * m_options.voxelSize();
  const std::size_t stride[3] = {static_cast<std::size_t>(m_count[1]) * m_count[2],
                                 static_cast<std::size_t>(m_count[2]), 1};
  for (std::size_t n = 0; n < open.size(); ++n) {
    if (m_flood.reached[n] == 0 || -m_options.gravity.dot(place(n)) > highest) continue;
    if (liquid[n] > least) return false;
    for (int side = 0; side < 6; ++side) {
      const int a = side / 2, sign = side % 2 == 0 ? -1 : 1;
      const int at = static_cast<int>(n / stride[a]) % m_count[a];
      const bool last = at == (sign < 0 ? 0 : m_count[a] - 1);
      const double beyond = last ? open[n] - m_step : open[n + sign * static_cast<std::ptrdiff_t>(stride[a])];
      if (beyond > 0.0) continue;
      Vec3d wall = place(n);
      wall[a] += sign * m_step * open[n] / (open[n] - beyond);
      if (toLiquid(wall) > least) return false;
    }
  }
  return true;
}

// source: distances to it; taken: to all liquid that is ever poured or a source's, and to solids.
double Surroundings::roomFrom(const std::vector<float>& open, const std::vector<float>& source,
                              const std::vector<float>& taken) const {
  double least = INFINITY;
  std::vector<std::uint8_t> seen(open.size(), 0);
  std::vector<float> start(open.size(), 1.0f);
  for (std::size_t n = 0; n < open.size(); ++n) {
    if (source[n] >= 0.0f || open[n] <= 0.0f || seen[n] != 0) continue;
    start[n] = -1.0f;
    const Flood part = flood(open, start, INFINITY, 0.0);
    start[n] = 1.0f;
    double room = part.unbounded ? INFINITY : 0.0;
    for (std::size_t m = 0; m < open.size(); ++m) {
      if (part.reached[m] == 0) continue;
      seen[m] = 1;
      room += share(-taken[m], m_step) * m_step * m_step * m_step;
    }
    least = std::min(least, room);
  }
  return least;
}

bool Surroundings::reached(const Coord& cell) const {
  const Coord first =
      Coord(cell[0] * kSamplesPerCell, cell[1] * kSamplesPerCell, cell[2] * kSamplesPerCell) - m_first;
  for (int a = 0; a < 3; ++a)
    if (first[a] < 0 || first[a] >= m_count[a]) return m_flood.unbounded;
  for (int i = 0; i < kSamplesPerCell; ++i) {
    for (int j = 0; j < kSamplesPerCell; ++j) {
      for (int k = 0; k < kSamplesPerCell; ++k) {
        const std::size_t n =
            (static_cast<std::size_t>(first[0] + i) * m_count[1] + first[1] + j) * m_count[2] + first[2] + k;
        if (m_flood.reached[n] != 0) return true;
      }
    }
  }
  return false;
}

double Surroundings::volumeIn(const sim::Shape& shape, double t,
                              const std::function<double(const Vec3d&)>& alsoIn) const {
  const sim::ShapeDistance distance(shape, m_options.voxelSize(), sim::domainBox(m_options));
  const sim::Solids solids(m_options);
  const std::vector<float> values = distances([&](const Vec3d& x) {
    const double own = std::max(distance(x), -solids.distance(x, t));
    return alsoIn ? std::max(own, alsoIn(x)) : own;
  });
  double volume = 0.0;
  for (const float value : values) volume += share(value, m_step);
  return volume * m_step * m_step * m_step;
}

double Surroundings::surfaceOf(const sim::Shape& shape, double t) const {
  const sim::ShapeDistance distance(shape, m_options.voxelSize(), sim::domainBox(m_options));
  const sim::Solids solids(m_options);
  const std::vector<float> away = distances(
      [&](const Vec3d& x) { return solids.distance(x, t) > 0.0 ? std::abs(distance(x)) : INFINITY; });
  // Layers within a sample of the surface, by how near they are.
  double layers = 0.0;
  for (const float value : away) layers += std::max(0.0, 1.0 - value / m_step);
  return layers * m_step * m_step;
}

double Surroundings::frontRate(const sim::Shape& shape, const Vec3d& velocity, double t) const {
  const sim::ShapeDistance distance(shape, m_options.voxelSize(), sim::domainBox(m_options));
  const sim::Solids solids(m_options);
  const std::vector<float> inside = distances([&](const Vec3d& x) { return distance(x); });
  const std::vector<float> open = distances([&](const Vec3d& x) { return solids.distance(x, t); });
  const std::size_t stride[3] = {static_cast<std::size_t>(m_count[1]) * m_count[2],
                                 static_cast<std::size_t>(m_count[2]), 1};
  double rate = 0.0;
  for (std::size_t n = 0; n < inside.size(); ++n) {
    if (std::abs(inside[n]) > 1.5 * m_step) continue;  // both neighbours are within or without
    double out = 0.0;
    for (int a = 0; a < 3; ++a) {
      const int at = static_cast<int>(n / stride[a]) % m_count[a];
      const double low = at > 0 ? share(inside[n - stride[a]], m_step) : 0.0;
      const double high = at + 1 < m_count[a] ? share(inside[n + stride[a]], m_step) : 0.0;
      out += velocity[a] * 0.5 * (low - high);
    }
    rate += std::max(0.0, out) * share(-open[n], m_step) * m_step * m_step;
  }
  return rate;
}

double Surroundings::highest(double t) const {
  double top = -INFINITY;
  for (const Body& body : m_bodies)
    if (body.from <= t) top = std::max(top, body.highest);
  return top;
}

}  // namespace fluidtex::stress
