#include "sim/pressure/tension_pressure.h"

#include "sim/surface/curvature.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

// Whether the liquid's own surface is on this side of the cell, and not an open side of the domain.
bool meetsAir(const SolidField& solid, const LiquidSides& cell, const Coord& place, int side) {
  return cell.theta[side] > 0.0f && solid.domain.isInside(neighborOf(place, side));
}

// Curvature of the surface nearest to a cell; where phi is not smooth there, the mean over its air neighbours
// where it is. One value for all sides: where the surface almost touches a cell's centre, the pressures at
// its sides act over almost no distance, and a difference between them would eject the liquid.
float ownCurvature(const openvdb::tree::ValueAccessor<const FloatTree>& curvature, const SolidField& solid,
                   const LiquidSides& cell, const Coord& place) {
  float own = 0.0f, sum = 0.0f;
  if (curvature.probeValue(place, own)) return own;
  int count = 0;
  for (int s = 0; s < kSides; ++s) {
    float beside = 0.0f;
    if (!meetsAir(solid, cell, place, s) || !curvature.probeValue(neighborOf(place, s), beside)) continue;
    sum += beside;
    ++count;
  }
  return count > 0 ? sum / static_cast<float>(count) : own;
}

}  // namespace

SurfacePressure::SurfacePressure(const LiquidCells& liquid, const FloatGrid& phi, const SolidField& solid,
                                 double scale)
    : m_row(liquid.numbering.size(), -1) {
  std::vector<int> cells;
  for (int i = 0; i < static_cast<int>(m_row.size()); ++i) {
    const Coord place = liquid.numbering.cell(i);
    bool any = false;
    for (int s = 0; s < kSides; ++s) any = any || meetsAir(solid, liquid.sidesOf(i), place, s);
    if (!any) continue;
    m_row[i] = static_cast<int>(cells.size());
    cells.push_back(i);
  }
  m_value.resize(cells.size());
  const FloatGrid::Ptr curvature = surfaceCurvature(phi, *solid.phi, solid.visibility.get());
  tbb::parallel_for(Range(0, static_cast<int>(cells.size()), 1024), [&](const Range& range) {
    const openvdb::tree::ValueAccessor<const FloatTree> bend(curvature->constTree());
    for (int n = range.begin(); n < range.end(); ++n) {
      const LiquidSides& cell = liquid.sidesOf(cells[n]);
      const Coord place = liquid.numbering.cell(cells[n]);
      const float own = ownCurvature(bend, solid, cell, place);
      for (int s = 0; s < kSides; ++s) {
        if (!meetsAir(solid, cell, place, s)) continue;
        float beside = 0.0f;
        const bool smooth = bend.probeValue(neighborOf(place, s), beside);
        m_value[n][s] = scale * (own + (smooth ? double(cell.theta[s]) * (beside - own) : 0.0));
      }
    }
  });
}

std::vector<double> guessedPressure(const LiquidCells& liquid, const SurfacePressure& surface) {
  const auto n = static_cast<std::size_t>(liquid.numbering.size());
  std::vector<double> guess(n, 0.0);
  std::vector<char> known(n, 0);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const LiquidSides& cell = liquid.sidesOf(static_cast<int>(i));
    double total = 0.0, weights = 0.0;
    for (int s = 0; s < kSides; ++s) {
      if (cell.theta[s] <= 0.0f) continue;
      const double weight = cell.open[s] / cell.theta[s];
      total += weight * surface.at(static_cast<int>(i), s);
      weights += weight;
    }
    if (weights <= 0.0) continue;
    guess[i] = total / weights;
    known[i] = 1;
    sum += guess[i];
    count += 1.0;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (known[i] == 0 && count > 0.0) guess[i] = sum / count;
  return guess;
}

double anchoredBy(const LiquidSides& cell) {
  double anchored = 1.0;
  for (int s = 0; s < kSides; ++s) {
    if (cell.theta[s] > 0.0f) anchored += cell.open[s] / cell.theta[s];
  }
  return anchored;
}

Tension tensionOf(const LiquidCells& liquid, const FloatGrid& phi, const SolidField& solid, double scale) {
  if (!(scale > 0.0)) return {};
  Tension tension{SurfacePressure(liquid, phi, solid, scale), {}, {}};
  if (tension.surface.none()) return tension;
  tension.guess = guessedPressure(liquid, tension.surface);
  tension.detached.resize(tension.guess.size());
  for (std::size_t i = 0; i < tension.guess.size(); ++i)
    tension.detached[i] = tension.guess[i] * (1.0 - 1.0 / anchoredBy(liquid.sidesOf(static_cast<int>(i))));
  return tension;
}

}  // namespace fluidtex::sim
