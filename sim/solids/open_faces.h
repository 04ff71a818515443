// How much of the faces of cells solids leave open.
#pragma once

#include "sim/solids/solid_field.h"

#include <array>

namespace fluidtex::sim {

// Distances to solids below this share of a cell are 0: a wall in the plane of faces closes them, in spite of
// rounding. It is as much as a cell's centre may lie less than half a cell deep and yet count as deep
// (kDeepInSolid), so that no face leads into a cell of which such a wall leaves a sliver.
inline constexpr double kOnWall = 0.01;

// Open shares of the lower faces of a block's cells, by axis.
using FaceShares = std::array<std::array<float, kLeafSize>, 3>;

// Of the block that begins at `origin`, from distances (metres) at the corners of its cells. A wall thinner
// than a cell may have no corner in it, and yet nothing passes: faces between cells that it parts are shut,
// and of a cell that it runs through, what is not on the cell's own side. cellDistances: the distances at
// cells' centres, to more solids maybe. Faces that do not touch a cell of the domain are shut.
FaceShares openFaceShares(const SolidDistance& distance, const FloatTree& cellDistances,
                          const CoordBBox& domain, double h, const Coord& origin);

// Open share of a square face from the solid's signed distance at its corners, taken linear along the edges
// (marching squares): d00, d10, d11, d01 in order around the face, positive where open.
// Ng, Min, Gibou, "An efficient fluid-solid coupling algorithm for single-phase flows", 2009.
double openAreaFraction(double d00, double d10, double d11, double d01);

}  // namespace fluidtex::sim
