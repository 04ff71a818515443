// Directions for the orientation field to follow (OrientWishes::direction). Each function returns one tangent
// vector per vertex; its length is the confidence, 0 (none) to 1.
#pragma once

#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::texture {

// Tangent part of one direction, of any length; less confident the more the surface faces it.
std::vector<Vec3f> alongDirection(const SurfaceMesh& mesh, const Vec3f& direction);

// Along velocities (#V, m/s). Low confidence below the speed `still` (m/s, > 0).
std::vector<Vec3f> alongFlow(const SurfaceMesh& mesh, const std::vector<Vec3f>& velocity, double still);

// Along the principal direction of larger absolute curvature: a line, of which either sense may be returned.
// Low confidence where both curvatures are alike, or the radius is many spacings. Shape operator by least
// squares from the normals around each vertex (Rusinkiewicz: Estimating Curvatures and Their Derivatives on
// Triangle Meshes, 2004, here per vertex), averaged over neighbours.
std::vector<Vec3f> alongBend(const SurfaceMesh& mesh);

// Along vectors of any length (#V). No confidence where they are zero or no numbers.
std::vector<Vec3f> alongVectors(const SurfaceMesh& mesh, const std::vector<Vec3f>& vectors);

// Along a vector grid, sampled linearly at the vertices. No confidence where it is zero.
std::vector<Vec3f> alongField(const SurfaceMesh& mesh, const openvdb::Vec3SGrid& field);

}  // namespace fluidtex::texture
