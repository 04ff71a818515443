// Curvature of the liquid's surface.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Sum of the two principal curvatures at the closest point of the surface, 1/m, for cells with one of the six
// neighbours on the other side of the surface. 2 / radius for a drop (positive) or a bubble (negative).
// Second-order where the surface is smooth on the grid; at most 1 / h in magnitude, that of a drop of two
// cells' radius.
// Active where phi is smooth around the cell, and within a cell of walls. In the middle of films and gaps and
// at corners the value is there, but inactive.
// phi: metres, a distance within two cells of the surface. solidPhi: metres, at cell centres.
// At walls phi is mirrored, so that surface tension pulls the surface to a right angle with them. Without it
// drops between two walls tilt and shake. Where a surface meets the wall at a small angle, mirroring makes a
// corner: it is what pulls such a front back, and not a corner of the liquid.
// visibility: of the solids. Beside a thin one, whose own gradient may lead to its other side, phi is
// mirrored at the wall's plane as seen from the cell.
//
// Source: Kang, Fedkiw, Liu, "A boundary condition capturing method for multiphase incompressible flow",
// 2000, section 3. Gaussian curvature, to go from the level of phi at the cell to the surface: Goldman,
// "Curvature formulas for implicit curves and surfaces", 2005.
FloatGrid::Ptr surfaceCurvature(const FloatGrid& phi, const FloatGrid& solidPhi,
                                const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
