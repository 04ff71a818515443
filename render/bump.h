// Bump mapping: shading normals perturbed by a relief, without displacing the surface [Blinn78, Simulation of
// wrinkled surfaces].
#pragma once

#include "render/options.h"
#include "render/vec.h"
#include "texture/surface.h"

#include <vector>

namespace fluidtex::render {

// The normals (#V, unit) of the surface perturbed by bump.map, before they are normalised:
//  - values h: N - g, where g is the gradient along the surface of height * spacingAt * h, per vertex the
//    mean of its triangles' by area;
//  - normals M: N + height * (M / (M . N) - N), M . N being taken as 0.05 at least.
// Throws std::invalid_argument if the surface has no such map, no normals, or, for values, no spacing.
std::vector<Vec3f> bumpedNormals(const texture::TexturedSurface& surface, const Bump& bump);

// Whether the surface has the map, of values or of normals.
bool hasMap(const texture::TexturedSurface& surface, const Bump& bump);

}  // namespace fluidtex::render
