// Free slip: the velocity at closed faces.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// After extrapolation: removes the normal component of the velocity, relative to the solid, at faces whose
// open area fraction is below kLeastOpen and which are not in `valid`, so that liquid slides along solids and
// does not enter them. Beside cells active in `separating` (liquid that separates from a wall), and where no
// liquid touches, only motion into the solid is removed. Faces inside a thin wall, which both of its sides
// read, take the wall's velocity; where liquid separates on one side only, that of the next face on that side
// if it leads away from the wall faster. Changes active faces only, and none beyond sides of the domain that
// are not closed.
void constrainToSolids(Velocity& velocity, const FloatGrid& phi, const SolidField& solid,
                       const FaceMasks& valid, const MaskGrid& separating);

}  // namespace fluidtex::sim
