// Velocity beyond the liquid: every active face gets the value of the liquid nearest to it.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <vector>

namespace fluidtex::sim {

// Fills every active face of u, v, w that is not in `valid`, constant along the normals: in the air along
// those of phi's level sets, behind the surface of solids along those of the solid's distance. `phi` and
// `solidPhi` in metres at cell centres, negative inside. A face that no valid face can reach gets 0. Other
// faces stay as they are.
void extrapolate(Velocity& velocity, const FaceMasks& valid, const FloatGrid& phi, const FloatGrid& solidPhi);

// The same for one to three fields of one topology at once: what says from where to where they go on is found
// once.
struct Extrapolated {
  Velocity& field;
  const FaceMasks& valid;
};
void extrapolate(const std::vector<Extrapolated>& fields, const FloatGrid& phi, const FloatGrid& solidPhi);

}  // namespace fluidtex::sim
