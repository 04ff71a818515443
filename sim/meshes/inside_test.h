// Winding numbers of closed surfaces.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/meshes/triangle_tree.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fluidtex::sim {

// Winding numbers of triangles that together are closed, by the line along an axis through a place. Which
// triangles it crosses is decided exactly (on a lattice of 2^-29 of the mesh's width), also where it runs
// along edges and through vertices.
class InsideTest {
 public:
  explicit InsideTest(TriangleMesh mesh);
  explicit InsideTest(std::shared_ptr<const TriangleTree> surface);

  // A crossing of the vertical line at (x, y) with a triangle: its height, and whether the line enters (1) or
  // leaves (-1) on its way down. Crossings are not sorted.
  struct Crossing {
    double z;
    int step;
  };
  using Crossings = std::vector<Crossing>;
  void crossings(double x, double y, Crossings& found) const;

  // Winding number of the place along the line: above 0 inside surfaces that are turned outward, 0 outside.
  static int winding(const Crossings& crossings, double z);
  // By the line along an axis; one that does not run along the surface beside the place takes less time.
  int winding(const Vec3d& x, int axis = 2) const;

 private:
  using Lattice = std::array<std::int32_t, 3>;
  Lattice onLattice(const Vec3d& x) const;
  // Calls body(place along the axis, step) for the crossings above x, and for some or all of those below.
  template <class Body>
  void forCrossings(const Vec3d& x, int axis, const Body& body) const;

  std::shared_ptr<const TriangleTree> m_surface;
  openvdb::BBoxd m_bounds;
  std::vector<Lattice> m_places;  // of the vertices
  double m_step = 1.0;            // of the lattice, metres
};

}  // namespace fluidtex::sim
