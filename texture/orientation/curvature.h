// How a surface bends.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// Mean curvature at every vertex, 1/m: the mean of the two principal ones, above 0 on crests and drops (1 / r
// on a ball of radius r), averaged over a few spacings. From how normals turn along the edges. Throws
// std::invalid_argument if the mesh is not closed and manifold.
std::vector<float> meanCurvature(const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
