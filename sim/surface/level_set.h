// The liquid's surface: phi, a narrow-band level set in metres, negative inside, at cell centres.
// Active voxels: |phi| < the grid's background and not deep in a solid. All others hold +-background.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Half the width of phi's narrow band in voxels, for steps of at most `cfl` cells.
int bandWidth(double cfl);

// Subtracts solids from the liquid, phi = max(phi, -solidPhi), in the cells active in `where`.
void cutSolids(FloatGrid& phi, const FloatGrid& solidPhi, const MaskGrid& where);

// Updates the active voxels, sets all others to +-background, and drops leaves without active voxels.
void trimBand(FloatGrid& phi, const FloatGrid& solidPhi);

// Adds liquid: phi = min(phi, distance) in the leaves that touch the box and where the distance is less than
// the background. Call redistance() and trimBand() afterwards; until then all leaves of phi are active as a
// whole.
// distance: metres, at world positions. Its sign must be right and its magnitude a lower bound.
void unite(FloatGrid& phi, const std::function<double(const Vec3d&)>& distance, const CoordBBox& within);
// The same for a shape, within the domain (see domainCells) and a leaf beyond it.
// distance: to the part of the shape's surface that counts; to all of it where none is given.
// Throws std::invalid_argument where the shape is unbounded on an unbounded side of the domain.
void unite(FloatGrid& phi, const ShapeDistance& shape, const CoordBBox& domain,
           const std::function<double(const Vec3d&)>& distance = {});

// The textured surface: liquid minus solids, max(phi, -solidPhi), as a distance within `halfWidth` voxels of
// it. Throws std::invalid_argument where halfWidth < 1.
FloatGrid::Ptr visibleSurface(const FloatGrid& phi, const SolidField& solid, int halfWidth);

// Volume that the surface encloses outside solids, cubic metres (see sim/surface/cell_volume.h).
double liquidVolume(const FloatGrid& phi, const SolidField& solid);

// Number of the domain's cells with phi < 0 whose centre is not in a solid.
std::int64_t liquidCells(const FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
