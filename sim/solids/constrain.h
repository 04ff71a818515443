// What closed faces do to the velocity: free slip along solids.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// After extrapolation: takes the normal component out of the velocity at closed faces (those not in `valid`),
// so that liquid slides along solids and does not enter them; all relative to the solid's own speed. Beside
// cells active in `separating` (liquid that leaves a wall) and where no liquid touches, only motion into the
// solid is taken out. Faces between the two sides of a thin wall, which both read, move with the wall.
// Touches active faces only.
void constrainToSolids(FloatGrid& u, FloatGrid& v, FloatGrid& w, const FloatGrid& phi,
                       const SolidField& solid, const FaceMasks& valid, const MaskGrid& separating);

}  // namespace fluidtex::sim
