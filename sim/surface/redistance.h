// Redistancing (reinitialisation): phi becomes a signed distance again.
// Sources: Sussman, Smereka and Osher, "A level set approach for computing solutions to incompressible
// two-phase flow", 1994; Russo and Smereka, "A remark on computing distance functions", 2000, whose cells
// next to the surface keep its place.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// How far one iteration of redistance() carries the distance away from the surface, in voxels.
inline constexpr double kRedistanceReach = 0.4;

// Turns phi into a signed distance near the surface, without moving the surface: cells next to it use its
// place between the cell centres, to fourth order where it is smooth and three cells from solids. Cells more
// than half a cell deep in solids keep their values (see sim/surface/extend_into_solids.h).
void redistance(FloatGrid& phi, const FloatGrid& solidPhi, int iterations = 8,
                const Visibility* visibility = nullptr);

// The same, with phi mirrored at symmetry sides, which do not count as solids.
void redistance(FloatGrid& phi, const SolidField& solid, int iterations);

}  // namespace fluidtex::sim
