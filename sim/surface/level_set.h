// The liquid's surface: phi, a narrow-band level set in metres, negative inside, at cell centres.
// Active voxels: |phi| < the grid's background and not deep in a solid. All others hold +-background.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Half the width of phi's band in voxels, for steps of at most `cfl` cells.
int bandWidth(double cfl);

// Takes solids out of the liquid, phi = max(phi, -solidPhi), in the cells active in `where`.
void cutSolids(FloatGrid& phi, const FloatGrid& solidPhi, const MaskGrid& where);

// Sets the active voxels anew, clamps all others, and drops leaves without any.
void trimBand(FloatGrid& phi, const FloatGrid& solidPhi);

// phi = min(phi, distance) in the leaves that touch the box and where that is less than the background: call
// redistance() and trimBand() afterwards. All leaves that phi then has are active as a whole. distance: at
// world positions; at least its sign and a lower bound of its magnitude are right.
void unite(FloatGrid& phi, const std::function<double(const Vec3d&)>& distance, const CoordBBox& within);
// The same wherever the shape is in the domain (see domainCells) and a leaf beyond. Throws
// std::invalid_argument where it has no end. distance: to what of the shape's surface counts, all of it where
// none is given.
void unite(FloatGrid& phi, const ShapeDistance& shape, const CoordBBox& domain,
           const std::function<double(const Vec3d&)>& distance = {});

// The textured surface: liquid with solids taken out, max(phi, -solidPhi), a distance `halfWidth` voxels
// either side.
FloatGrid::Ptr visibleSurface(const FloatGrid& phi, const SolidField& solid, int halfWidth);

// Cubic metres that the surface encloses outside solids (see sim/surface/cell_volume.h).
double liquidVolume(const FloatGrid& phi, const SolidField& solid);

// Cells of the domain with phi < 0 whose centre is not in a solid.
std::int64_t liquidCells(const FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
