// Gaps between liquid and the solids that it separates from.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/surface/level_set.h"

namespace fluidtex::sim {

// Opens a gap in phi (metres) behind liquid that separates from a solid: the cells active in `separating`.
// Elsewhere the surface is extrapolated into the solid (see extendIntoSolids), and the narrow band is
// trimmed.
// A film on a wall that holds no cell centre separates where the velocity, after the projection, points away
// from the wall. Gaps close where the liquid moves against the solid or gravity drives it there.
// kick: what gravity adds to the velocity in a step of dt seconds, m/s.
void openGaps(FloatGrid& phi, const Velocity& velocity, const SolidField& solid, const MaskGrid& separating,
              const Vec3d& kick, double dt);

}  // namespace fluidtex::sim
