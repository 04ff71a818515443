// Face area fractions: the share of a cell's face that solids leave open.
#pragma once

#include "sim/solids/solid_field.h"

#include <array>

namespace fluidtex::sim {

// Distances to solids below this share of a cell count as 0: a wall in the plane of faces closes them, in
// spite of rounding. It equals the tolerance of kDeepInSolid (a centre less than half a cell deep counts as
// deep), so that no face leads into a cell of which such a wall leaves a sliver.
inline constexpr double kOnWall = 0.01;

// Open area fractions of the lower faces of a block's cells, by axis.
using FaceShares = std::array<std::array<float, kLeafSize>, 3>;

// Open area fractions of the block that begins at `origin`, from distances (metres) at the corners of its
// cells.
// A wall thinner than a cell may have no corner in it, and still nothing passes: faces between two cell
// centres that it separates are closed, and so is the part of a cell that it runs through which is not on the
// cell's own side. Faces that do not touch a cell of the domain are closed.
// cellDistances: distances at cell centres, possibly to more solids.
FaceShares openFaceShares(const SolidDistance& distance, const FloatTree& cellDistances,
                          const CoordBBox& domain, double h, const Coord& origin);

// Open area fraction of a square face from the solid's signed distance at its corners, linear along the edges
// (marching squares). d00, d10, d11, d01: in order around the face, positive where open.
// Source: Ng, Min, Gibou, "An efficient fluid-solid coupling algorithm for single-phase flows", 2009.
double openAreaFraction(double d00, double d10, double d11, double d01);

}  // namespace fluidtex::sim
