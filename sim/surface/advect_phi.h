// The surface carried along: advection of the level set.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Moves phi with the velocity for dt seconds:  d(phi)/dt + u . grad(phi) = 0. Each cell takes the value from
// where it came (semi-Lagrangian, cubic interpolation where phi is smooth near the surface), in as many
// sub-steps as moves of kMaxTrace cells ask for. Leaves are added where the surface can get to. Values
// outside the velocity's leaves stay, and those deeper in solids than kSolidLayers. visibility: of the solids
// (SolidField), null for none that are thin.
void advectPhi(FloatGrid& phi, const Velocity& velocity, const FloatGrid& solidPhi, double dt,
               const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
