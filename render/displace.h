// Displacement: a relief that moves the surface, so that its outline and its shadow change.
#pragma once

#include "render/options.h"
#include "texture/surface.h"

namespace fluidtex::render {

// Of the surface what a picture needs: positions moved along the normals by height * spacingAt * value,
// normals tilted by the relief's slope (as bumpedNormals()), triangles, colours, contact, velocity, spacing,
// scale and maps. Where the surface touches a solid it stays. Throws std::invalid_argument if the surface has
// no such map of values, no normals or no spacing.
texture::TexturedSurface displaced(const texture::TexturedSurface& surface, const Bump& displacement);

}  // namespace fluidtex::render
