// Advection of a scalar that moves with the liquid.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// The scalar after dt seconds of advection by `velocity`, in the liquid's cells (phiTo < 0) of the leaves of
// `like`. Semi-Lagrangian with a third-order Runge-Kutta back-trace and MacCormack's correction,
// limited to the values around the traced point. Traces end in solids (see TraceEnd).
// from: extrapolated as far as the velocity leads.
FloatGrid::Ptr advectScalar(const FloatGrid& from, const Velocity& velocity, const FloatTree& like,
                            const FloatGrid& phiTo, const SolidField& solid, double dt);

}  // namespace fluidtex::sim
