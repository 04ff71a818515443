// A bounding-volume tree of triangles: which of them is nearest to a place, and which lie beyond it.
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
  // The closest point of all triangles; of several equally near, that of the first triangle. guess: estimated
  // upper bound of the distance, metres; a good one saves time, a wrong one costs some.
  Closest closest(const Vec3d& x, double guess) const;

  // Calls body(triangle) for all triangles that the line from x up an axis crosses, and for some others;
  // those that it misses by less than `margin` are included.
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
  // Four boxes of triangles. Where `count` is 0 the box is that of the node `first`; else it holds `count` of
  // m_triangles, from `first` on; kNothing where there are fewer than four.
  struct alignas(16) Node {
    float low[3][kWays], high[3][kWays];
    int first[kWays], count[kWays];
  };
  struct Triangle {
    openvdb::Vec3I corners;
    int number;
  };
  class Sought;
  // The depth-first search keeps three nodes of each level, and the levels are as many as the logarithm of
  // the number of triangles.
  static constexpr int kMostWaiting = 64;

  void build(const std::vector<openvdb::Vec3f>& middles, int node, int below, int first, int count);
  // Partitions `count` triangles at the median along the longest axis of their box, the lower half first.
  int halved(const std::vector<openvdb::Vec3f>& middles, int first, int count);
  void setBox(Node& node, int way, int first, int count) const;
  void search(const Vec3d& x, Closest& closest) const;

  TriangleMesh m_mesh;
  std::vector<Triangle> m_triangles;  // #T: as the leaves of the tree hold them
  std::vector<Node> m_nodes;
};

}  // namespace fluidtex::sim
