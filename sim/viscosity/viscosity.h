// Implicit viscosity.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <cstdint>

namespace fluidtex::sim {

struct ViscosityOptions {
  double tolerance = 1e-6;  // of the residual's 2-norm, relative to the right-hand side's
  int maxIterations = 1000;
  // Viscosity is neglected where viscosity dt / (density h^2) is below this everywhere. At a CFL number of 1
  // the flow about a cell then has a Reynolds number of over 10,000, and the viscous loss is far below the
  // numerical dissipation of advection.
  double negligible = 1e-4;
};

// Whether a viscosity (Pa s) is below ViscosityOptions::negligible.
bool isNegligible(double viscosity, double dt, double density, double h,
                  const ViscosityOptions& options = {});

struct ViscosityReport {
  bool converged = true;
  bool skipped = false;  // it was negligible; the velocity is unchanged
  int iterations = 0;
  double residual = 0.0;   // relative 2-norm at the end
  std::int64_t faces = 0;  // unknowns
};

// Dynamic viscosity in Pa s: constant, or a grid at cell centres of phi's index space, valid one cell around
// the liquid.
struct ViscosityField {
  double constant = 0.0;
  const FloatGrid* variable = nullptr;  // in place of the constant where given
};

// Whether applyViscosity() would be skipped: the viscosity is below ViscosityOptions::negligible everywhere.
bool isNegligible(const ViscosityField& viscosity, double dt, double density, double h,
                  const ViscosityOptions& options = {});

// Replaces u, v, w (m/s) in the liquid by the solution of  density (u - u_before) / dt = div(viscosity (grad
// u + grad u^T)). Implicit in time, so that any dt is stable; the full stress tensor, which couples the three
// components.
// phi: metres, extrapolated into solids. dt: s. density: kg/m3.
// Boundary conditions: no stress at the surface. At solids the normal component is the solid's, and the
// tangential ones follow SolidField::slipLength and slide. At free-slip solids that are oblique to the axes
// the normal component is left to the pressure.
// Reads and writes faces beside a cell with phi < 0, and faces in solids next to them, which get the solid's
// velocity. A rigid motion (translation, rotation) is preserved. Bit-identical on any number of threads.
// Where it fails to converge the report says so, and the velocity is unchanged. Throws std::invalid_argument
// where the density is not positive, or dt or the viscosity negative.
//
// Source: Batty and Bridson, "Accurate viscous free surfaces for buckling, coiling, and rotating liquids",
// 2008.
[[nodiscard]] ViscosityReport applyViscosity(Velocity& velocity, const FloatGrid& phi,
                                             const SolidField& solid, double dt, double density,
                                             const ViscosityField& viscosity,
                                             const ViscosityOptions& options = {});

}  // namespace fluidtex::sim
