// The pressure that surface tension gives to the liquid's surface.
#pragma once

#include "sim/pressure/liquid_cells.h"

#include <vector>

namespace fluidtex::sim {

// Where each liquid cell meets the surface on its six sides: surface tension times curvature, in units of
// LiquidSides' q. 0 on other sides, and everywhere where there is no surface tension.
class SurfacePressure {
 public:
  SurfacePressure() = default;
  // scale: of 1/m of curvature, in units of q.
  SurfacePressure(const LiquidCells& liquid, const FloatGrid& phi, const SolidField& solid, double scale);

  bool none() const { return m_row.empty(); }
  double at(int cell, int side) const {
    return m_row.empty() || m_row[cell] < 0 ? 0.0 : m_value[m_row[cell]][side];
  }

 private:
  std::vector<int> m_row;  // #cells, into m_value; -1 where there is no surface
  std::vector<std::array<double, kSides>> m_value;
};

// A guess at the pressure: at cells beside the surface that of the surface, by how near it is on each side;
// elsewhere the mean of those. What is left to solve for is small then even where the surface is close to a
// cell's centre, which would else outweigh all other cells in the residual.
std::vector<double> guessedPressure(const LiquidCells& liquid, const SurfacePressure& surface);

}  // namespace fluidtex::sim
