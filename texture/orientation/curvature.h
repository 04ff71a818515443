// Curvature of a surface.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// #V, mean curvature, 1/m: mean of the principal curvatures, positive on crests and drops (1 / r on a ball of
// radius r), averaged over a few spacings. Half the divergence of the mesh's normals. Throws
// std::invalid_argument if the mesh is not closed and manifold.
std::vector<float> meanCurvature(const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
