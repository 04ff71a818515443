// Triangulation of polygons in space.
#pragma once

#include "sim/options.h"

#include <array>
#include <vector>

namespace fluidtex::sim {

// The triangles of a polygon, with its orientation; their corners are among its own. It need be neither
// convex nor flat. corners: three or more indices of points.
std::vector<std::array<std::size_t, 3>> cutPolygon(const std::vector<Vec3d>& points,
                                                   const std::vector<std::size_t>& corners);

}  // namespace fluidtex::sim
