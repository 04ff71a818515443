// Triangles in a tree of boxes: which of them is nearest to a place, and which lie beyond it.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/vec3.h"

#include <array>
#include <vector>

namespace fluidtex::sim {

class TriangleTree {
 public:
  explicit TriangleTree(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return m_mesh; }

  struct Closest {
    double square;  // of the distance, m2
    int triangle;   // -1: there is none
    Vec3d weight;   // of its corners: the closest point is their sum
  };
  // The closest point of all triangles; where several have it, of the first. `guess`: how far away it is at
  // most, as far as is known (metres); a good one saves time, a wrong one costs some.
  Closest closest(const Vec3d& x, double guess) const;

  // Calls body(triangle) for all triangles that the line from x up an axis passes, and some that it does not;
  // those that it passes by less than `margin` are among them.
  template <class Body>
  void forBeyond(const Vec3d& x, int axis, double margin, const Body& body) const {
    std::array<int, kMostWaiting> waiting;
    int size = 0;
    waiting[size++] = 0;
    while (size > 0) {
      const Node& node = m_nodes[waiting[--size]];
      for (int n = 0; n < kWays; ++n) {
        bool beside = node.count[n] == kNothing;
        for (int a = 0; a < 3; ++a)
          beside = beside || (a != axis && node.low[a][n] > x[a] + margin) || node.high[a][n] < x[a] - margin;
        if (beside) continue;
        if (node.count[n] == 0) waiting[size++] = node.first[n];
        for (int i = 0; i < node.count[n]; ++i) body(m_triangles[node.first[n] + i].number);
      }
    }
  }

 private:
  static constexpr int kWays = 4, kNothing = -1;
  // Four boxes around some triangles each: either those of the node `first`, where `count` is 0, or `count`
  // of m_triangles, from `first` on; kNothing where there are fewer than four.
  struct alignas(16) Node {
    float low[3][kWays], high[3][kWays];
    int first[kWays], count[kWays];
  };
  struct Triangle {
    openvdb::Vec3I corners;
    int number;
  };
  class Sought;
  // Of each level of the tree three nodes wait, and levels are as many as the logarithm of the number of
  // triangles.
  static constexpr int kMostWaiting = 64;

  void build(const std::vector<openvdb::Vec3f>& middles, int node, int below, int first, int count);
  // Puts the lower half of so many triangles, along the longest axis of their box, before the others.
  int halved(const std::vector<openvdb::Vec3f>& middles, int first, int count);
  void setBox(Node& node, int way, int first, int count) const;
  void search(const Vec3d& x, Closest& closest) const;

  TriangleMesh m_mesh;
  std::vector<Triangle> m_triangles;  // #T: as the leaves of the tree hold them
  std::vector<Node> m_nodes;
};

}  // namespace fluidtex::sim
