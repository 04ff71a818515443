// The volume deficit: liquid that the surface has lost (negative: gained), stored where that happened,
// advected with the flow and given back there. A level set alone loses films, sheets and drops thinner than
// its cells; a volume of fluid in flux form is exact in sum but not sharp. Here phi says where the surface
// is, the fluxes say how much liquid there should be, and the difference is the deficit. It gathers in the
// liquid next to it and drives an expansion or contraction there (PressureOptions::divergence). Conservative,
// and local: liquid elsewhere does not move. Source of the coupling: Sussman and Puckett, "A coupled level
// set and volume-of-fluid method for computing 3D and axisymmetric incompressible two-phase flows", 2000.
#pragma once

#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// The surface before and after a step.
struct MovedLiquid {
  const FloatGrid& before;             // phi
  const FloatGrid& after;              // phi
  const FloatGrid* deficit = nullptr;  // before the step; null: none
};

struct MovedSolids {
  const SolidField& before;  // while the velocity held
  const SolidField& after;
};

// The deficit after a step of dt seconds in which `velocity` moved the surface: in units of h^3 at cell
// centres, negative where there is too much liquid.
// Volumes are advected by fluxes through the solids' open faces (sim/volume/volume_flux.h). What leaves
// through sides of the domain is gone, and so is what is due within a cell of drains. Sources refill their
// cells without deficit, but liquid that meets them from outside becomes deficit. Liquid that solids push
// aside, or cover between two steps (dt 0), becomes deficit beside them. The sum of the enclosed volume
// (liquidVolume) and the deficit is exact. Bit-identical on any number of threads.
FloatGrid::Ptr volumeDeficit(const MovedLiquid& liquid, const Velocity& velocity, const MovedSolids& solids,
                             const RunningFlows& flows, double dt);

}  // namespace fluidtex::sim
