#include "sim/shapes/surface_velocity.h"

#include "sim/meshes/triangle_mesh.h"

#include <utility>

namespace fluidtex::sim {

SurfaceVelocity::SurfaceVelocity(TriangleMesh mesh, std::vector<openvdb::Vec3f> velocity)
    : m_surface(std::move(mesh)), m_velocity(std::move(velocity)) {}

Vec3d SurfaceVelocity::at(const Vec3d& x, double reach) const {
  const TriangleTree::Closest closest = m_surface.closest(x, reach);
  Vec3d velocity(0.0);
  if (closest.triangle < 0) return velocity;
  const openvdb::Vec3I& t = m_surface.mesh().triangles[closest.triangle];
  for (int k = 0; k < 3; ++k) velocity += closest.weight[k] * Vec3d(m_velocity[t[k]]);
  return velocity;
}

}  // namespace fluidtex::sim
