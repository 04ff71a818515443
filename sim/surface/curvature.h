// How the liquid's surface bends.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

namespace fluidtex::sim {

// Curvature of the liquid's surface at cells of which one of the six neighbours lies on its other side: the
// sum of the two principal curvatures at the surface's nearest point, 1/m, 2 / radius for a drop (positive)
// or a bubble (negative). Of second order where the surface is smooth on the grid; at most 1 / h, that of a
// drop of two cells' radius. Active where phi bends smoothly around the cell, and within a cell of walls; in
// the middle of films and gaps and at corners a value is there, but it is not active. phi: metres, a distance
// two cells around the surface. At walls, where solidPhi (metres, cell centres) changes its sign, phi is
// mirrored, so that the surface is pulled until it meets them at a right angle. Without that nothing holds it
// upright there, and drops between two walls tilt until they shake. The corner that mirroring makes of a
// surface that meets the wall at a small angle is what draws such a front back, and no corner of the liquid.
// visibility: of the solids; beside a thin one, whose own slope may lead to its other side, phi is mirrored
// at the wall's plane as the cell sees it.
//
// Source: Kang, Fedkiw, Liu, "A boundary condition capturing method for multiphase incompressible flow",
// 2000, section 3; Gaussian curvature, to go from the level of phi at the cell to the surface: Goldman,
// "Curvature formulas for implicit curves and surfaces", 2005.
FloatGrid::Ptr surfaceCurvature(const FloatGrid& phi, const FloatGrid& solidPhi,
                                const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
