// The velocity of a surface that changes its shape, and of what is beside it.
#pragma once

#include "sim/shapes.h"

#include <vector>

namespace fluidtex::sim {

// A velocity given at the vertices of a mesh, linear over its triangles; beside the surface it is that of the
// closest point on it.
class SurfaceVelocity {
 public:
  // velocity: #V, m/s.
  SurfaceVelocity(TriangleMesh mesh, std::vector<openvdb::Vec3f> velocity);

  // m/s. `reach`: how far away the surface is at most, as far as is known (metres); a good guess saves time,
  // a wrong one costs some.
  Vec3d at(const Vec3d& x, double reach) const;

 private:
  // A box around some triangles: either those of two nodes, at `first` and `first` + 1, or `count` of
  // m_order, from `first` on.
  struct Node {
    openvdb::Vec3f low, high;
    int first = 0, count = 0;
  };
  struct Closest {
    double square;  // of the distance
    int triangle;
    Vec3d weight;  // of its corners
  };
  void build(int node, int first, int count);
  double squareTo(const Node& node, const Vec3d& x) const;
  void search(const Vec3d& x, Closest& closest) const;

  TriangleMesh m_mesh;
  std::vector<openvdb::Vec3f> m_velocity;
  std::vector<int> m_order;  // #T: triangles, as the leaves of the tree hold them
  std::vector<Node> m_nodes;
};

}  // namespace fluidtex::sim
