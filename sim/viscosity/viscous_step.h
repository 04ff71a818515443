// The viscous part of a step in which forces and pressure also act.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/viscosity/viscosity.h"

namespace fluidtex::sim {

struct ViscousStepReport {
  ViscosityReport viscosity;
  PressureReport pressure;  // of the projection that viscosity starts from

  bool converged() const { return viscosity.converged && (viscosity.skipped || pressure.converged); }
};

// Adds the viscous change over dt seconds to a velocity on which forces, but no pressure yet, have acted: V(P
// u) - P u, with V the viscous solve (sim/viscosity/viscosity.h) and P the projection
// (sim/pressure/pressure.h). The step's own projection follows later. The velocity is unchanged where
// viscosity is negligible or a solve does not converge.
//
// Why not V u: a force such as gravity is a gradient, which the pressure removes as a whole. At walls that
// hold the liquid V damps it, more beside the walls than in the middle, and what is left is no gradient any
// more. With  u' = P V (u + dt g)  liquid at rest would circulate for ever: its fixed point is  (1 - P V) u =
// P V dt g, of the order of dt |g| and not 0. With the change of P u the fixed point of liquid at rest under
// its own pressure is rest, whatever the walls, the cells and the viscosity: P (dt g) = 0, so viscosity has
// nothing to act on. P V P is symmetric with eigenvalues in [0, 1], so viscosity still only dissipates
// energy.
// Source of the order of the solves: Batty and Bridson, "Accurate viscous free surfaces for buckling,
// coiling, and rotating liquids", 2008, section 4.
[[nodiscard]] ViscousStepReport applyViscousStep(Velocity& velocity, const FloatGrid& phi,
                                                 const SolidField& solid, double dt, double density,
                                                 const ViscosityField& viscosity,
                                                 const PressureOptions& pressure);

}  // namespace fluidtex::sim
