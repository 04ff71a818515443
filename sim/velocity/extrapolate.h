// Extrapolation of velocity beyond the liquid.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <vector>

namespace fluidtex::sim {

// Fills every active face of u, v, w that is not in `valid` with the value of the nearest liquid, constant
// along normals: in the air along those of phi's level sets, behind the surface of solids along those of the
// solid's distance. A face that no valid face can reach gets 0. Other faces keep their values.
// phi, solidPhi: metres, at cell centres, negative inside. visibility: as in SolidField; nothing is
// extrapolated through a thin wall, and faces in one are extrapolated to, but not from.
void extrapolate(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi, const FloatGrid& solidPhi,
                 const Visibility* visibility = nullptr);

// The same for one to three fields of one topology at once, which share the order of faces.
struct Extrapolated {
  Velocity& field;
  const FaceMasks& valid;
};
void extrapolate(const std::vector<Extrapolated>& fields, const FloatGrid& phi, const FloatGrid& solidPhi,
                 const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
