// A textured surface's maps on a mesh of someone else's: any triangles near by, closed or not.
#pragma once

#include "texture/surface.h"

namespace fluidtex::transport {

// Every vertex of the mesh gets what is at the closest point of `surface`, of the side that faces as it does
// where there is one within a few spacings: colour, velocity, age and the further maps by barycentric
// interpolation; exemplar coordinate from the nearest corner and its gradient; orientation by a cubic,
// directions that turns of 360 / symmetry degrees make equal counting as one, laid into the vertex's tangent
// plane; vectors of maps from the corners that agree with the nearest one, turned with the normal and of
// length 1 or 0; contact of the nearest corner. Normals are the mean of the triangles around, by area. trust
// falls with the distance from the surface. previousPosition is where the place was, or, where there was no
// earlier frame, the vertex itself. An empty surface gives grey vertices without trust. Throws
// std::invalid_argument if a triangle's vertex does not exist.
texture::TexturedSurface onto(const texture::TexturedSurface& surface, std::vector<texture::Vec3f> positions,
                              std::vector<texture::Vec3I> triangles, int symmetry = 1);

}  // namespace fluidtex::transport
