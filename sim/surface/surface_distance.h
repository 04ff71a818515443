// Closest-point redistancing: distances of cells near the surface to the closest point on it.
#pragma once

#include "sim/grid/mac_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// Second differences of phi above this share of its slope mark corners, or the middle of a film or a gap.
inline constexpr double kSharpSlope = 0.7;

// A cell of a leaf, by its offset, and its new phi in units of h.
struct CellDistance {
  std::int16_t offset;
  float phi;
};

// Signed distances, in units of h, of a leaf's cells at most three cells from a change of phi's sign along an
// axis. The surface is the zero set of the tricubic (Lagrange) interpolation of phi, fourth-order where phi
// is smooth. Newton's method finds the closest point.
// Left out: cells marked in notAsked, cells where the surface is not smooth on the grid (corners, films,
// gaps), and cells whose search does not end on the surface.
// Source: Chopp, "Some improvements of the fast marching method", 2001, section 3.
std::vector<CellDistance> surfaceDistances(const FloatTree& phi, const Coord& origin, float h,
                                           const std::array<bool, kLeafSize>& notAsked);

}  // namespace fluidtex::sim
