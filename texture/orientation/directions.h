// Directions that an orientation field can be asked to follow (OrientWishes::direction). Each function gives
// one tangent vector a vertex, whose length says how much the direction means there, 0 (nothing) to 1.
#pragma once

#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::texture {

// The tangent part of one direction, which need not be of unit length; the less, the more the surface faces
// it.
std::vector<Vec3f> alongDirection(const SurfaceMesh& mesh, const Vec3f& direction);

// Along velocities (#V, m/s). What is slower than `still` (m/s, > 0) means little.
std::vector<Vec3f> alongFlow(const SurfaceMesh& mesh, const std::vector<Vec3f>& velocity, double still);

// Along the lines in which the surface bends most, which are no arrows: of the two senses either may come.
// They mean little where the surface bends alike in all directions, or with a radius of many spacings. From
// the turn of the normals around each vertex (Rusinkiewicz: Estimating Curvatures and Their Derivatives on
// Triangle Meshes, 2004, here by vertex), averaged over neighbours.
std::vector<Vec3f> alongBend(const SurfaceMesh& mesh);

// Along a grid of vectors, sampled linearly at the vertices. Where it is zero it means nothing.
std::vector<Vec3f> alongField(const SurfaceMesh& mesh, const openvdb::Vec3SGrid& field);

}  // namespace fluidtex::texture
