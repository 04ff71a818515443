// Sampling of solids on the grid.
#pragma once

#include "sim/solids/chunks.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Half width of the narrow band of a solid's distance, voxels.
inline constexpr int kSolidBand = 3;

// Signed distance in metres at a world position, negative inside solids, never too large in magnitude.
using SolidDistance = std::function<double(const Vec3d&)>;

// Layers of cells around the domain in which distances are known.
inline constexpr int kSolidMargin = 8;

// Distances at cell centres and open area fractions of faces, in these chunks. h: metres.
// distance: to solids and all sides of the domain. openDistance: to solids and closed sides only. mirrored:
// for SolidField::phiMirrored, empty without symmetry sides.
SolidField makeSolidField(const SolidDistance& distance, const SolidDistance& openDistance,
                          const SolidDistance& mirrored, const CoordBBox& domain, Chunks chunks, double h);

}  // namespace fluidtex::sim
