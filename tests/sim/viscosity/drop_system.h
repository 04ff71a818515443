// The viscous system of a liquid in a tank, and its matrix as its definition says.
#pragma once

#include "sim/viscosity/viscous_system.h"
#include "tests/sim/viscosity/viscous_tank.h"

#include <vector>

namespace fluidtex::sim {

// viscosity dt / (density h^2) is `number`.
inline ViscousSystem systemOf(const Tank& tank, double number, std::vector<double>& before) {
  const double dt = 0.01;
  return viscousSystem(tank.velocity, *tank.phi, tank.solid, dt, kDensity,
                       {.constant = number * kDensity * tank.h * tank.h / dt}, before);
}

// Strain of a sample, without its offset. x: #faces + 1.
inline double strainAt(const StrainSample& s, const std::vector<double>& x) {
  return s.a * (x[s.face[1]] - x[s.face[0]]) + s.b * (x[s.face[3]] - x[s.face[2]]);
}

// The gradient of the energy with respect to the unknowns, without what walls add. x: #faces + 1.
inline std::vector<double> multiplied(const ViscousSystem& system, const std::vector<double>& x) {
  std::vector<double> y(system.unknowns, 0.0);
  for (std::int32_t i = 0; i < system.unknowns; ++i) y[i] = system.mass[i] * x[i];
  for (const StrainSample& s : system.samples) {
    const double stress = s.weight * strainAt(s, x);
    const double slope[4] = {-s.a, s.a, -s.b, s.b};
    for (int n = 0; n < 4; ++n)
      if (s.face[n] < system.unknowns) y[s.face[n]] += slope[n] * stress;
  }
  return y;
}

}  // namespace fluidtex::sim
