// Pressure of surface tension at the liquid's surface.
#pragma once

#include "sim/pressure/liquid_cells.h"

#include <vector>

namespace fluidtex::sim {

// Surface tension times curvature where a liquid cell meets the surface, on each of its six sides, in units
// of LiquidSides' q. 0 on other sides, and everywhere without surface tension.
class SurfacePressure {
 public:
  SurfacePressure() = default;
  // scale: q per curvature of 1/m.
  SurfacePressure(const LiquidCells& liquid, const FloatGrid& phi, const SolidField& solid, double scale);

  bool none() const { return m_row.empty(); }
  double at(int cell, int side) const {
    return m_row.empty() || m_row[cell] < 0 ? 0.0 : m_value[m_row[cell]][side];
  }

 private:
  std::vector<int> m_row;  // #cells, into m_value; -1 where there is no surface
  std::vector<std::array<double, kSides>> m_value;
};

// Initial guess of the pressure. At cells beside the surface the surface's pressure, weighted by how near it
// is on each side; elsewhere the mean of those. What remains to be solved for is then small even where the
// surface is close to a cell's centre; such a cell would otherwise dominate the residual.
std::vector<double> guessedPressure(const LiquidCells& liquid, const SurfacePressure& surface);

// 1 plus the surface's part of a cell's diagonal entry, which grows as the surface comes near the centre.
double anchoredBy(const LiquidSides& cell);

// What surface tension does to the pressure. All empty without it.
struct Tension {
  SurfacePressure surface;
  std::vector<double> guess;  // #cells: of the pressure
  // #cells: pressure of detached ones, that of the air, but near their own surface that of surface tension.
  // Otherwise the pressure difference would act over almost no distance.
  std::vector<double> detached;
};

// scale: q per curvature of 1/m; 0 without surface tension.
Tension tensionOf(const LiquidCells& liquid, const FloatGrid& phi, const SolidField& solid, double scale);

}  // namespace fluidtex::sim
