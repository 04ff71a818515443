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
// Normals are area-weighted means of the triangles around. trust: the surface's, times a factor that falls
// with the distance from it (landingTrust()). previousPosition: the vertex minus the closest point's
// displacement since the previous frame. An empty surface gives mid grey, coordinates 0 and trust 0, and
// previousPosition is the vertex itself. Throws std::invalid_argument if a triangle's vertex does not exist.
texture::TexturedSurface onto(const texture::TexturedSurface& surface, std::vector<texture::Vec3f> positions,
                              std::vector<texture::Vec3I> triangles, int symmetry = 1);

}  // namespace fluidtex::transport
