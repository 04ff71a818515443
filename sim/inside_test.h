// Whether a place lies inside closed surfaces.
#pragma once

#include "sim/shapes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// Winding numbers of triangles that together are closed, by the vertical line through a place: which
// triangles it meets is decided exactly (on a lattice of 2^-29 of the mesh's width), also where it runs along
// edges and through vertices. Holds a reference to the mesh.
class InsideTest {
 public:
  explicit InsideTest(const TriangleMesh& mesh);

  // Where the line at (x, y) passes a triangle: its height, and whether it comes in (1) or out (-1) on its
  // way down. Not sorted.
  struct Crossing {
    double z;
    int step;
  };
  using Crossings = std::vector<Crossing>;
  void crossings(double x, double y, Crossings& found) const;

  // How often the surfaces go around the place, as seen along the line: above 0 inside surfaces that are
  // turned outward, 0 outside.
  static int winding(const Crossings& crossings, double z);
  int winding(const Vec3d& x) const;

 private:
  using Lattice = std::array<std::int64_t, 2>;
  Lattice onLattice(double x, double y) const;
  std::array<int, 2> binOf(const Lattice& place) const;

  const TriangleMesh& m_mesh;
  openvdb::BBoxd m_bounds;
  std::vector<Lattice> m_places;  // of the vertices
  double m_step = 1.0;            // of the lattice, metres
  Lattice m_span{1, 1};           // all places are less
  // Which triangles lie above the cells of a grid of m_bins x m_bins: those of cell n are from m_first[n] on.
  int m_bins = 1;
  std::vector<std::size_t> m_first;
  std::vector<std::uint32_t> m_triangles;
};

}  // namespace fluidtex::sim
