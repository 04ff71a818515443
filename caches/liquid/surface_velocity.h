// Velocity around a surface whose points have velocities.
#pragma once

#include "caches/liquid/closest_triangles.h"
#include "sim/grid/mac_grid.h"

#include <vector>

namespace fluidtex::caches {

// Cells around the surface in which velocities are looked for at least, and used at most.
inline constexpr int kLeastReach = 6, kMostReach = 24;

// Cells of side h around a surface that a frame's motion may lead through, within these bounds: what `band`
// below has to be. velocity: of its points, #P x 3; the fastest hundredth, which are stray drops, do not
// count. seconds: of the frame.
int reachInCells(const std::vector<float>& velocity, double seconds, double h);

// Velocity in the cells within `band` cells of the surface, m/s, at their centres. velocity: of the points,
// #P x 3, finite. Along the surface linear within triangles; off it by its derivative along the normal n, up
// to two cells, and constant from there on. The part of it along the surface follows from the derivatives
// there, grad_s u, since a free surface has no shear stress; that across the surface is taken to be 0:
//   du/dn = -(grad_s u)^T n
// so that whatever turns as a solid is continued exactly. Mean over the triangles around a point and its
// neighbours.
sim::FaceGrids velocityOffSurface(ClosestTriangles& closest, const std::vector<float>& velocity, int band);

}  // namespace fluidtex::caches
