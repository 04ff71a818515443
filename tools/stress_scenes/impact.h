// Liquid that is poured with a velocity into a wall.
#pragma once

#include "sim/options.h"

namespace fluidtex::stress {

// The greatest speed, m/s, at which walls drive out a body of liquid beside them as it is poured, besides its
// own: they stop it at once. Beside an upright wall, at x from it along the surface, liquid of depth H that
// came at U then rises at (2 U / pi) ln coth(pi x / 4 H) (Peregrine, "Flow due to a vertical plate moving in
// a channel", 1972), without bound at the wall: in the first cell by what it is at its middle. Where walls
// meet the speeds add.
double impactSpeed(const sim::Options& options);

}  // namespace fluidtex::stress
