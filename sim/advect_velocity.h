// Velocity carried along.
#pragma once

#include "sim/mac_grid.h"

namespace fluidtex::sim {

// Writes to `to` what has become of the face values `carried` after dt seconds in the velocity `from` (`from`
// itself, for self-advection), at the active faces of `to` that
// touch liquid (a cell with phiTo < 0); other faces stay as they are. Semi-Lagrangian with a third-order
// Runge-Kutta back-trace and MacCormack's correction, limited to the values around the traced point; plain
// semi-Lagrangian where the samples are not all well inside the liquid. phiFrom, phiTo: the surface before
// and after, metres. `from` and `carried`, of one topology, must be extrapolated for at least dt max|u| / h +
// 2 cells around the liquid.
void advectVelocity(const Velocity& from, const Velocity& carried, Velocity& to, const FloatGrid& phiFrom,
                    const FloatGrid& phiTo, double dt);

}  // namespace fluidtex::sim
