// Advection of the level set.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Advects phi for dt seconds:  d(phi)/dt + u . grad(phi) = 0. Semi-Lagrangian; cubic interpolation where phi
// is smooth near the surface, linear elsewhere.
// A move of more than kMaxTrace cells is split into equal sub-steps. Leaves are added where the surface can
// get to. Unchanged: values outside the velocity's leaves, and values deeper in solids than kSolidLayers.
// phi, solidPhi: metres, at cell centres. visibility: of the solids (SolidField), null where none is thin.
void advectPhi(FloatGrid& phi, const Velocity& velocity, const FloatGrid& solidPhi, double dt,
               const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
