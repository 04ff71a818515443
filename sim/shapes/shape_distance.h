// Shapes as signed distances.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <openvdb/openvdb.h>

#include <memory>

namespace fluidtex::sim {

inline const openvdb::BBoxd kEverywhere{Vec3d(-kForever), Vec3d(kForever)};

// Signed distance to the shape in metres, negative inside, exact for single shapes and a lower bound in
// magnitude for unions and differences near their creases. Evaluated at world positions; meshes are turned
// into a level set once.
class ShapeDistance {
 public:
  // domain: height fields go on for ever where they reach its sides, and where it is infinite; `reach`, the
  // same where it is not given: where distances to meshes are asked for, others need not be right. A mesh
  // sequence is as in its first file. Throws MeshError and HeightError, also where one is so large that it
  // would not fit into memory.
  ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain = kEverywhere);
  ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain,
                const openvdb::BBoxd& reach);
  ShapeDistance(const TriangleMesh& mesh, double voxelSize, const openvdb::BBoxd& reach = kEverywhere);
  double operator()(const Vec3d& x) const;

  // Of what of the shape lies in a box, metres, not always the smallest; infinite where the box is and it has
  // no end, as half-spaces, and ground whose rim goes on.
  openvdb::BBoxd boundsIn(const openvdb::BBoxd& box) const;

 private:
  struct Node;
  std::shared_ptr<const Node> m_root;
};

}  // namespace fluidtex::sim
