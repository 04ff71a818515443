// Heat carried along by the liquid.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// The temperature after dt seconds of being carried by `velocity`, in the liquid's cells (phiTo < 0) of the
// leaves of `like`: semi-Lagrangian with a third-order Runge-Kutta back-trace and MacCormack's correction,
// limited to the values around the traced point. `from` must be extended as far as the velocity leads. Traces
// end in solids (see TraceEnd).
FloatGrid::Ptr advectTemperature(const FloatGrid& from, const Velocity& velocity, const FloatTree& like,
                                 const FloatGrid& phiTo, const SolidField& solid, double dt);

}  // namespace fluidtex::sim
