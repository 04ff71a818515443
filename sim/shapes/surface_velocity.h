// Velocity of a surface that changes its shape, and beside it.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/meshes/triangle_tree.h"

#include <vector>

namespace fluidtex::sim {

// A velocity given at the vertices of a mesh, linear over its triangles; beside the surface it is that of the
// closest point on it.
class SurfaceVelocity {
 public:
  // velocity: #V, m/s.
  SurfaceVelocity(TriangleMesh mesh, std::vector<openvdb::Vec3f> velocity);

  // Velocity at x, m/s. reach: estimated upper bound of the distance to the surface, metres; a good one saves
  // time, a wrong one costs some.
  Vec3d at(const Vec3d& x, double reach) const;

 private:
  TriangleTree m_surface;
  std::vector<openvdb::Vec3f> m_velocity;
};

}  // namespace fluidtex::sim
