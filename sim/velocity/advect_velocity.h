// Velocity carried along.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Writes to `to` what has become of the face values `carried` after dt seconds in the velocity `from` (`from`
// itself, for self-advection), at the active faces of `to` that touch liquid (a cell with phi < 0; phi: the
// surface after, metres); other faces stay as they are. Semi-Lagrangian with a third-order Runge-Kutta
// back-trace and cubic interpolation, limited to the values around the traced point. `from` and `carried`, of
// one topology, must be extrapolated for at least dt max|u| / h + 2 cells around the liquid. Traces end in
// solids (see TraceEnd; solidPhi, visibility: as in SolidField).
void advectVelocity(const Velocity& from, const Velocity& carried, Velocity& to, const FloatGrid& phi,
                    const FloatGrid& solidPhi, double dt, const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
