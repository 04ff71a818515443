// Solids on the grid.
#pragma once

#include "sim/solids.h"

#include <functional>

namespace fluidtex::sim {

// Voxels of a solid's distance on each side of its surface.
inline constexpr int kSolidBand = 3;

// Metres at a world position, negative inside solids, never too large in magnitude.
using SolidDistance = std::function<double(const Vec3d&)>;

// Distances at cells and open shares of faces. `distance`: to solids and all sides of the domain;
// `openDistance`: to solids and those sides only that are walls.
SolidField makeSolidField(const SolidDistance& distance, const SolidDistance& openDistance,
                          const openvdb::Coord& cells, double h);

}  // namespace fluidtex::sim
