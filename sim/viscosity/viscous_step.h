// What friction does to liquid on which forces and pressure act in the same step.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/viscosity/viscosity.h"

namespace fluidtex::sim {

struct ViscousStepReport {
  ViscosityReport viscosity;
  PressureReport pressure;  // of the balance that friction starts from

  bool converged() const { return viscosity.converged && (viscosity.skipped || pressure.converged); }
};

// Adds to a velocity that forces, but no pressure yet, have acted on what friction takes from it in `dt`
// seconds: V(P u) - P u, with V the viscous solve (sim/viscosity/viscosity.h) and P the projection
// (sim/pressure/pressure.h). The projection proper is still to come. Nothing is touched where friction is
// negligible or a solve does not converge.
//
// Why not V u: a force such as gravity is a gradient, which the pressure takes away as a whole. Where walls
// hold the liquid V bites into it, more beside the walls than in the middle, and what is left is no gradient
// any more. With  u' = P V (u + dt g)  liquid at rest would turn over for ever: its fixed point is
// (1 - P V) u = P V dt g, of the order of dt |g| and not 0. With the change of P u the fixed point of liquid
// at rest under its own pressure is rest, whatever the walls, the cells and the viscosity: P (dt g) = 0, so
// friction has nothing to act on. P V P is symmetric with eigenvalues in [0, 1], so friction still only takes
// energy away.
// Source of the order of the solves: Batty and Bridson, "Accurate viscous free surfaces for buckling,
// coiling, and rotating liquids", 2008, section 4.
[[nodiscard]] ViscousStepReport applyViscousStep(Velocity& velocity, const FloatGrid& phi,
                                                 const SolidField& solid, double dt, double density,
                                                 const ViscosityField& viscosity,
                                                 const PressureOptions& pressure);

}  // namespace fluidtex::sim
