// Solids on the grid.
#pragma once

#include "sim/solids/chunks.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Voxels of a solid's distance on each side of its surface.
inline constexpr int kSolidBand = 3;

// Metres at a world position, negative inside solids, never too large in magnitude.
using SolidDistance = std::function<double(const Vec3d&)>;

// Layers of cells around the domain in which distances are known.
inline constexpr int kSolidMargin = 8;

// Distances at cells and open shares of faces, in these chunks. `distance`: to solids and all sides of the
// domain; `openDistance`: to solids and those sides only that are closed; `mirrored`: for
// SolidField::phiMirrored, empty where no side is one of symmetry.
SolidField makeSolidField(const SolidDistance& distance, const SolidDistance& openDistance,
                          const SolidDistance& mirrored, const CoordBBox& domain, Chunks chunks, double h);

}  // namespace fluidtex::sim
