// What several of the fluid tests need: a solver that starts from a given velocity, and figures of its state.
#pragma once

#include "sim/step/solver.h"

#include <functional>

namespace fluidtex::validation {

// A solver whose first frame has been made, with this velocity (m/s, at world positions) given to every
// active face at that time. Later velocities are later than the frame's time by State::leapfrogOffset.
// Nothing is projected: the field should be free of divergence on the faces.
sim::Solver startedWith(const sim::Options& options,
                        const std::function<sim::Vec3d(const sim::Vec3d&)>& velocity);

// Height of the surface above the floor in the column of cells (i, j), by linear interpolation of phi; 0
// without liquid.
double surfaceHeight(const sim::State& state, int i, int j, int cells);

// Liquid in the column of cells (i, j, 0 .. cells - 1), in metres of depth.
double columnDepth(const sim::State& state, int i, int j, int cells);

}  // namespace fluidtex::validation
