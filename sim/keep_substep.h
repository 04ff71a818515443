// What a frame keeps of a step: the velocity where the surface can have been.
#pragma once

#include "sim/frame.h"
#include "sim/mac_grid.h"

#include <array>

namespace fluidtex::sim {

// A velocity in the leaves of phi's band only; its own grids where nothing is left out.
Velocity nearSurface(const Velocity& velocity, const FloatGrid& phi);

// The substep of a velocity without leaves that nobody reads who follows the surface for dt seconds: those
// farther from both `surfaces`, before and after the step, than half the way that the flow leads there, and
// from the surfaces of solids, along which the liquid's surface runs; each with room for an interpolation.
// Both narrow-band distances in metres; solids: before and after the step.
Substep keepSubstep(double dt, const Velocity& velocity, const std::array<const FloatGrid*, 2>& surfaces,
                    const std::array<const FloatGrid*, 2>& solids);

}  // namespace fluidtex::sim
