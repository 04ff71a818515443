#include "tools/stress_scenes/budget.h"

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"
#include "sim/solids/solids.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::stress {
namespace {

// Of what a source gave. Its front is as fine as the cells, and where liquid has crept over its bare sides it
// is taken away (sim/flows/flows.cpp).
constexpr double kSourceSlack = 0.05;

// Cells know edges and curved surfaces of what is poured to some hundredths of their size.
constexpr double kOfSurface = 0.05;

double rateAt(const sim::Source& source, double t) {
  if (source.rate.empty()) return 1.0;
  if (t <= source.rate.front().time) return source.rate.front().factor;
  for (std::size_t n = 1; n < source.rate.size(); ++n) {
    if (t > source.rate[n].time) continue;
    const sim::RatePoint &a = source.rate[n - 1], &b = source.rate[n];
    return a.factor + (t - a.time) / (b.time - a.time) * (b.factor - a.factor);
  }
  return source.rate.back().factor;
}

// m3/s that come through a source's front at a rate of 1: of the faces between its cells (those whose middle
// lies in it) and others, those that the velocity points out of, less what goes back in. Nothing comes where
// a solid is.
double frontRate(const sim::Source& source, const sim::Options& options, double t) {
  const double h = options.voxelSize();
  const sim::ShapeDistance shape(source.shape, h, sim::domainBox(options));
  sim::Solids solids(options);
  const auto field = solids.at(t);
  const auto& open = field->open.component;
  const sim::CoordBBox domain = sim::domainCells(options);
  const auto inside = [&](const Coord& cell) {
    return domain.isInside(cell) && shape((cell.asVec3d() + Vec3d(0.5)) * h) < 0.0;
  };
  // Whether liquid comes out of the source into this cell.
  const auto isFed = [&](const Coord& cell) {
    for (int a = 0; a < 3; ++a) {
      Coord upstream = cell;
      upstream[a] += source.velocity[a] > 0.0 ? -1 : source.velocity[a] < 0.0 ? 1 : 0;
      if (upstream != cell && inside(upstream)) return true;
    }
    return false;
  };
  double rate = 0.0;
  const openvdb::CoordBBox cells = sampledCells(options);
  for (int i = cells.min()[0]; i <= cells.max()[0]; ++i) {
    for (int j = cells.min()[1]; j <= cells.max()[1]; ++j) {
      for (int k = cells.min()[2]; k <= cells.max()[2]; ++k) {
        const Coord cell(i, j, k);
        if (!inside(cell)) continue;
        for (int a = 0; a < 3; ++a) {
          const bool up = source.velocity[a] > 0.0;
          Coord next = cell, face = cell;
          next[a] += up ? 1 : -1;
          if (up) face[a] += 1;
          if (!inside(next)) rate += std::abs(source.velocity[a]) * open[a]->tree().getValue(face) * h * h;
          // From one step of a round front into the next.
          Coord back = cell, into = cell;
          back[a] -= up ? 1 : -1;
          if (!up) into[a] += 1;
          if (domain.isInside(back) && !inside(back) && isFed(back))
            rate -= std::abs(source.velocity[a]) * open[a]->tree().getValue(into) * h * h;
        }
      }
    }
  }
  return rate;
}

bool takesAway(const sim::Options& options) {
  return !options.drains.empty() ||
         std::any_of(options.sides.begin(), options.sides.end(),
                     [](sim::Side side) { return side == sim::Side::open || side == sim::Side::stream; });
}

bool brings(const sim::Options& options) {
  return std::find(options.sides.begin(), options.sides.end(), sim::Side::stream) != options.sides.end();
}

}  // namespace

bool happens(double time, double from, double to, double frameRate) {
  const double same = 1e-6 / frameRate;
  return time > from + same && time <= to + same;
}

VolumeBudget::VolumeBudget(const sim::Options& options, const Surroundings& surroundings)
    : m_options(options), m_surroundings(surroundings), m_given(options.sources.size(), 0.0) {}

double VolumeBudget::tolerance() const {
  return 0.01 * m_most + std::pow(m_options.voxelSize(), 3) + m_slack;
}

double VolumeBudget::start(double volume) {
  const double poured = m_surroundings.pouredVolume();
  m_most = std::max(volume, poured);
  m_low = m_high = volume;
  const double allowed = tolerance() + kOfSurface * m_options.voxelSize() * m_surroundings.pouredSurface() +
                         m_surroundings.besideThinWalls();
  // What drains take away at once may be missing, and what cells do not see of a source: unlike liquid that
  // is poured it owes nothing, as it is filled again in each step.
  double missing = 0.0;
  for (const sim::Drain& drain : m_options.drains)
    if (drain.from <= 0.0) missing += m_surroundings.volumeIn(drain.shape, 0.0);
  for (const sim::Source& source : m_options.sources)
    if (source.from <= 0.0) missing += m_surroundings.volumeIn(source.shape, 0.0);
  if (volume > poured + allowed) return volume - poured;
  const double low = poured - missing - m_surroundings.inNarrowGaps() - allowed;
  return volume < low ? volume - poured : 0.0;
}

double VolumeBudget::advance(double from, double to, double volume) {
  bool exact = true;
  for (const sim::LiquidBody& body : m_options.liquid) {
    if (!happens(body.from, from, to, m_options.frameRate)) continue;
    // Where there is liquid already none is added.
    const double shape = m_surroundings.volumeIn(body.shape, body.from);
    m_slack += kOfSurface * m_options.voxelSize() * 6.0 * std::pow(shape, 2.0 / 3.0);
    m_high += shape;
    m_low += std::max(0.0, shape - m_low);
    exact = false;
  }
  for (const sim::Solid& solid : m_options.solids) {
    if (!happens(solid.from, from, to, m_options.frameRate)) continue;
    // What was where it appears is gone.
    m_low = std::max(0.0, m_low - m_surroundings.volumeIn(solid.shape, solid.from - 1e-6));
    exact = false;
  }
  for (std::size_t n = 0; n < m_options.sources.size(); ++n) {
    const sim::Source& source = m_options.sources[n];
    const double begin = std::max(from, source.from), end = std::min(to, source.until);
    if (begin >= end) continue;
    const double length = end - begin, factor = 0.5 * (rateAt(source, begin) + rateAt(source, end));
    const double given = frontRate(source, m_options, 0.5 * (begin + end)) * factor * length;
    // Or what the shape's own front would give; cells know it no better than that.
    const double smooth =
        m_surroundings.frontRate(source.shape, source.velocity, 0.5 * (begin + end)) * factor * length;
    m_high += std::max(given, smooth);
    // Into a full room a source gives nothing. Several may have to share theirs.
    const double room = m_surroundings.roomFor(n) / static_cast<double>(m_options.sources.size());
    const double least = std::min({given, smooth, std::max(0.0, room - m_given[n])});
    m_low += least;
    m_given[n] += least;
    // As it begins its shape is filled. Later, what flows away is filled up where it is not driven itself: no
    // more than gravity draws out in that time.
    const double whole = m_surroundings.volumeIn(source.shape, to);
    if (happens(source.from, from, to, m_options.frameRate)) {
      m_high += whole;
      exact = false;
    }
    m_slack = std::max(m_slack, 0.25 * m_options.voxelSize() * std::pow(whole, 2.0 / 3.0) * 6.0);
    m_slack += kSourceSlack * given;
    if (source.velocity == Vec3d(0.0)) {
      const double fall = m_options.gravity.length() * to;
      m_high += 6.0 * std::pow(whole, 2.0 / 3.0) * fall * length;
      exact = false;
    }
  }
  if (takesAway(m_options)) {
    m_low = 0.0;
    exact = false;
  }
  if (brings(m_options)) m_high = sim::kForever;
  m_most = std::max(m_most, volume);
  const double allowed = tolerance();
  double outside = 0.0;
  if (volume > m_high + allowed) outside = volume - m_high;
  if (volume < m_low - allowed) outside = volume - m_low;
  if (!exact) m_low = m_high = std::clamp(volume, m_low, m_high);
  return outside;
}

}  // namespace fluidtex::stress
