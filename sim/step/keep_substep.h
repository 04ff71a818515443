// What a frame keeps of a step: the velocity where the surface can have been.
#pragma once

#include "sim/frame/frame.h"
#include "sim/grid/mac_grid.h"

#include <vector>

namespace fluidtex::sim {

// A velocity in the leaves of phi's band and of the surfaces of solids only: whoever follows the surface for
// a step, which runs along solids too, never leaves them. phi: before the step; its band is wider than a step
// is long. solids: distances (metres) before and after the step. The velocity's own grids where nothing is
// left out.
Velocity nearSurface(const Velocity& velocity, const FloatGrid& phi,
                     const std::vector<const FloatGrid*>& solids);

// The substep of a velocity, which leaves out the liquid's inside as nearSurface() does.
Substep keepSubstep(double dt, const Velocity& velocity, const FloatGrid& phi,
                    const std::vector<const FloatGrid*>& solids);

}  // namespace fluidtex::sim
