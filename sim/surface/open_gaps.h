// Where liquid lets go of solids.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/surface/level_set.h"

namespace fluidtex::sim {

// Makes phi (metres) know where liquid has let go of a solid, the cells active in `separating`: there a gap
// opens behind it, elsewhere the surface goes on into the solid (see extendIntoSolids). Films on walls that
// hold no cell's centre are let go where the velocity, after the projection, leads away. Gaps close where the
// liquid moves against the solid or gravity drives it there. kick: what gravity adds to the velocity in a
// step of dt seconds, m/s. Trims the band.
void openGaps(FloatGrid& phi, const Velocity& velocity, const SolidField& solid, const MaskGrid& separating,
              const Vec3d& kick, double dt);

}  // namespace fluidtex::sim
