// Acceleration by the forces of a step, kept for the next step.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/velocity/bodies.h"

namespace fluidtex::sim {

// u + time * a (m/s), on the topology of u; `a` counts as 0 where it has no values.
Velocity plus(const Velocity& u, const Velocity& a, double time);

// The acceleration (m/s2) that turned `before` into `after` within dt seconds, on the faces where `valid` is
// set; 0 elsewhere, for the caller to extrapolate. On the topology of `after`, which includes that of
// `before`; reuses the grids of `before`.
Velocity accelerationBy(Velocity before, const Velocity& after, const FaceMasks& valid, double dt);

// How much greater `a` was where each body's cells come from than it is where they are, as the mean over the
// body, and of that the share that is free along each axis. from: the velocity at the start of their way of
// dt seconds, as a field; to: the same as carried along, so that it is that at their places.
std::vector<Vec3d> meanChangeAlong(const Velocity& a, const Velocity& from, const Velocity& to,
                                   const Bodies& bodies, double dt);

// Adds time * (a + what the body that a face is of has in `change`) to u, which is on the leaves of the
// bodies.
void add(Velocity& u, const Velocity& a, const Bodies& bodies, const std::vector<Vec3d>& change, double time);

}  // namespace fluidtex::sim
