// What liquid meets at the surfaces of solids and at the domain's faces: whether it sticks, and to what.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Whether walls do anything to liquid that moves along them.
bool grips(const Wall& wall);

// Slip length in metres: how far behind the surface the velocity along it would be the wall's if it went on
// changing as it does in the liquid beside it (Navier). 0 where liquid sticks, infinite where it slips
// freely.
double slipLength(const Wall& wall);

// Fills SolidField::slipLength and slide. wallAt: the wall nearest to a world position; distance: as that of
// the field's phi, there the surface's velocity is made parallel to it.
void setWalls(SolidField& field, const std::function<const Wall&(const Vec3d&)>& wallAt,
              const std::function<double(const Vec3d&)>& distance);

// After constrainToSolids: gives closed faces in solids, those not in `valid`, the velocity that goes on from
// the liquid's through the wall's at the surface, so that what is traced along a wall where liquid sticks
// comes to rest there. Nothing where SolidField::slipLength is null.
void stickToWalls(Velocity& velocity, const SolidField& solid, const FaceMasks& valid);

}  // namespace fluidtex::sim
