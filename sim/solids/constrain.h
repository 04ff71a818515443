// Free slip: the velocity at closed faces.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// After extrapolation: removes the normal component of the velocity, relative to the solid, at closed faces
// (those not in `valid`), so that liquid slides along solids and does not enter them.
// Beside cells active in `separating` (liquid that separates from a wall), and where no liquid touches, only
// motion into the solid is removed. Faces in the middle of a thin wall, which both of its sides read, move
// with the wall. Changes active faces only.
void constrainToSolids(FloatGrid& u, FloatGrid& v, FloatGrid& w, const FloatGrid& phi,
                       const SolidField& solid, const FaceMasks& valid, const MaskGrid& separating);

}  // namespace fluidtex::sim
