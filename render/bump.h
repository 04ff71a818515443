// Relief that is in the light only: the surface stays as it is, its normals lean as if it had bumps [Blinn78,
// Simulation of wrinkled surfaces].
#pragma once

#include "render/options.h"
#include "render/vec.h"
#include "texture/surface.h"

#include <vector>

namespace fluidtex::render {

// The normals (#V, unit) of the surface with the relief of bump.map on it:
//  - values h: N - g, where g is the gradient along the surface of height * spacingAt * h, per vertex the
//    mean of its triangles' by area;
//  - normals M: N + height * (M / (M . N) - N), M . N being taken as 0.05 at least.
// Throws std::invalid_argument if the surface has no such map, or neither normals nor, for values, a spacing.
std::vector<Vec3f> bumpedNormals(const texture::TexturedSurface& surface, const Bump& bump);

// Whether the surface has the map, of values or of normals.
bool hasMap(const texture::TexturedSurface& surface, const Bump& bump);

}  // namespace fluidtex::render
