// The velocity that a frame keeps of a substep: that near surfaces.
#pragma once

#include "sim/frame/frame.h"
#include "sim/grid/mac_grid.h"

#include <memory>
#include <vector>

namespace fluidtex::sim {

// The velocity in the leaves of phi's narrow band and of the solids' surfaces only. A point that follows the
// surface for a step, along solids too, does not leave them.
// phi: before the step; its narrow band is wider than the step is long. solids: signed distances (metres)
// before and after the step. Returns the velocity's own grids where no leaf is left out.
Velocity nearSurface(const Velocity& velocity, const FloatGrid& phi,
                     const std::vector<const FloatGrid*>& solids);

// The substep of dt seconds with the velocity that nearSurface() leaves. visibility: as in SolidField, that
// by which the surface is moved.
Substep keepSubstep(double dt, const Velocity& velocity, const FloatGrid& phi,
                    const std::vector<const FloatGrid*>& solids,
                    std::shared_ptr<const Visibility> visibility = nullptr);

}  // namespace fluidtex::sim
