// Tangential boundary conditions at solids and at the domain's sides: free slip, no slip, Navier slip, and
// the walls' own velocity.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Whether the wall acts on liquid that moves along it: anything but free slip.
bool grips(const Wall& wall);

// Navier's slip length in metres: the depth behind the surface at which the tangential velocity, extrapolated
// linearly from the liquid, equals the wall's. 0 for no slip, infinite for free slip.
double slipLength(const Wall& wall);

// Fills SolidField::slipLength and slide. wallAt: the wall nearest to a world position. distance: that of the
// field's phi, whose surface the wall's velocity is made parallel to.
void setWalls(SolidField& field, const std::function<const Wall&(const Vec3d&)>& wallAt,
              const std::function<double(const Vec3d&)>& distance);

// After constrainToSolids: at faces in solids whose open area fraction is below kLeastOpen and which are not
// in `valid`, extrapolates the velocity linearly from the liquid's nearest face through the wall's velocity
// at the slip length behind the surface, at most to the mirror image. So what is traced along a no-slip wall
// comes to rest there. No effect where the wall slips freely or SolidField::slipLength is null.
void stickToWalls(Velocity& velocity, const SolidField& solid, const FaceMasks& valid);

}  // namespace fluidtex::sim
