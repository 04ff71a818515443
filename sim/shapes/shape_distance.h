// Signed distances of shapes.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <openvdb/openvdb.h>

#include <memory>

namespace fluidtex::sim {

inline const openvdb::BBoxd kEverywhere{Vec3d(-kForever), Vec3d(kForever)};

// Signed distance to the shape in metres at world positions, negative inside. Exact for single shapes, and a
// lower bound in magnitude for unions and differences near their creases. Meshes are converted to a level set
// once.
class ShapeDistance {
 public:
  // domain: height fields extend without end where they reach its sides, and where it is infinite. reach
  // (domain where it is not given): the region where distances to meshes are needed; elsewhere they need not
  // be right. A mesh sequence is as in its first file.
  // Throws MeshError and HeightError, also where a mesh or height field is too large for memory.
  ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain = kEverywhere);
  ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain,
                const openvdb::BBoxd& reach);
  ShapeDistance(const TriangleMesh& mesh, double voxelSize, const openvdb::BBoxd& reach = kEverywhere);
  double operator()(const Vec3d& x) const;

  // Bounds of the part of the shape in a box, metres, not always the smallest. Infinite where the box is and
  // the shape is unbounded, as half-spaces and ground that extends beyond its rim.
  openvdb::BBoxd boundsIn(const openvdb::BBoxd& box) const;

 private:
  struct Node;
  std::shared_ptr<const Node> m_root;
};

}  // namespace fluidtex::sim
