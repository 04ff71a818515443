// What the forces of a step do to the velocity, kept for the step after.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// u + time * a (m/s), on the topology of u; `a` counts as 0 where it has no values.
Velocity plus(const Velocity& u, const Velocity& a, double time);

// What turned `before` into `after` within dt seconds (m/s2), on the faces where `valid` is set; 0 elsewhere,
// for the caller to extrapolate. Of the topology of `after`, which has all that `before` has; in the grids of
// `before`.
Velocity accelerationBy(Velocity before, const Velocity& after, const FaceMasks& valid, double dt);

}  // namespace fluidtex::sim
