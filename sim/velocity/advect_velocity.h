// Advection of velocity.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Advects the face values `carried` for dt seconds with the velocity `from` (`from` itself, for
// self-advection), and writes them to `to` at its active faces that touch liquid (a cell with phi < 0); other
// faces keep their values.
// Semi-Lagrangian with a third-order Runge-Kutta back-trace and cubic interpolation, limited to the values
// around the traced point. Traces end in solids (see TraceEnd).
// phi: the surface after the step, metres. solidPhi, visibility: as in SolidField. `from` and `carried`, of
// one topology, must be extrapolated for at least dt max|u| / h + 2 cells around the liquid.
void advectVelocity(const Velocity& from, const Velocity& carried, Velocity& to, const FloatGrid& phi,
                    const FloatGrid& solidPhi, double dt, const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
