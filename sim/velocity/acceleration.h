// Acceleration by the forces of a step, kept for the next step.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// u + time * a (m/s), on the topology of u; `a` counts as 0 where it has no values.
Velocity plus(const Velocity& u, const Velocity& a, double time);

// The acceleration (m/s2) that turned `before` into `after` within dt seconds, on the faces where `valid` is
// set; 0 elsewhere, for the caller to extrapolate. On the topology of `after`, which includes that of
// `before`; reuses the grids of `before`.
Velocity accelerationBy(Velocity before, const Velocity& after, const FaceMasks& valid, double dt);

}  // namespace fluidtex::sim
