// A textured surface's maps on a mesh from elsewhere: any triangles close to it, closed or not.
#pragma once

#include "texture/surface.h"

namespace fluidtex::transport {

// Each vertex of the mesh takes the values at the closest point of `surface`, preferring triangles within a
// few spacings that face as it does:
//  - colour, velocity, age and further maps: barycentric;
//  - exemplar coordinate, and that which fades: from the nearest corner and its gradient;
//  - orientation: cubic, with directions equal under rotations by 360 / symmetry degrees as one, projected to
//    the vertex's tangent plane;
//  - vector maps: from corners that agree with the nearest one, turned with the normal, of length 1 or 0;
//  - contact, and whether the texture is original: from the nearest corner.
// Normals are area-weighted means of the triangles around. trust falls with the distance from the surface.
// previousPosition is that of the closest point's place, or the vertex itself without an earlier frame. An
// empty surface gives grey vertices without trust. Throws std::invalid_argument if a triangle's vertex does
// not exist.
texture::TexturedSurface onto(const texture::TexturedSurface& surface, std::vector<texture::Vec3f> positions,
                              std::vector<texture::Vec3I> triangles, int symmetry = 1);

}  // namespace fluidtex::transport
