// Viscosity: the velocity that the liquid's inner friction leaves after a time step.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <cstdint>

namespace fluidtex::sim {

struct ViscosityOptions {
  double tolerance = 1e-6;  // of the residual's 2-norm, relative to the right-hand side's
  int maxIterations = 1000;
  // Nothing is done where viscosity dt / (density h^2) stays below this everywhere: at a CFL number of 1 the
  // flow about a cell then has a Reynolds number of over 10,000, and friction is far below what the
  // transport of velocity loses on a grid.
  double negligible = 1e-4;
};

// Whether a viscosity (Pa s) is one that ViscosityOptions::negligible speaks of.
bool isNegligible(double viscosity, double dt, double density, double h,
                  const ViscosityOptions& options = {});

struct ViscosityReport {
  bool converged = true;
  bool skipped = false;  // it was negligible; nothing was touched
  int iterations = 0;
  double residual = 0.0;   // relative 2-norm at the end
  std::int64_t faces = 0;  // unknowns
};

// Dynamic viscosity in Pa s: the same everywhere, or from a grid at cell centres of phi's index space, valid
// one cell around the liquid.
struct ViscosityField {
  double constant = 0.0;
  const FloatGrid* variable = nullptr;  // in place of the constant where given
};

// Whether applyViscosity() would leave everything as it is: no part is above ViscosityOptions::negligible.
bool isNegligible(const ViscosityField& viscosity, double dt, double density, double h,
                  const ViscosityOptions& options = {});

// Replaces u, v, w (m/s) in the liquid by the solution of  density (u - u_before) / dt = div(viscosity (grad
// u + grad u^T)), implicit in time, so that any dt is stable; the whole stress, which couples the three
// components. No stress at the surface. At solids the component along the solid's normal is the solid's, and
// those along it follow SolidField::slipLength and slide. Read and written at faces beside a cell with phi <
// 0, and at faces in solids next to them, which get the solid's velocity. phi in metres, extended into
// solids. A motion without deformation (translation, rotation) comes out as it went in. At solids that slip
// and do not stand along an axis the normal component is left to the pressure. The same bytes on any number
// of threads. Does not throw when it fails to converge: the report says so, and nothing is touched; throws
// std::invalid_argument where the density is not positive, or dt or the viscosity negative.
//
// Source: Batty and Bridson, "Accurate viscous free surfaces for buckling, coiling, and rotating liquids",
// 2008.
[[nodiscard]] ViscosityReport applyViscosity(Velocity& velocity, const FloatGrid& phi,
                                             const SolidField& solid, double dt, double density,
                                             const ViscosityField& viscosity,
                                             const ViscosityOptions& options = {});

}  // namespace fluidtex::sim
