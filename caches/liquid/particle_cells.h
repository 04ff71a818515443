// Particles in the order of cells, to find those around a place.
#pragma once

#include <openvdb/openvdb.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace fluidtex::caches {

// Particles sorted by the cubic cell of side `reach` that they lie in, the cells by x, then y, then z. Holds
// a copy of the places in that order.
class ParticleCells {
 public:
  ParticleCells(const std::vector<openvdb::Vec3f>& points, double reach);

  double reach() const { return m_reach; }
  // Of the particles in the order of cells (#P): which of the given ones each is.
  const std::vector<std::uint32_t>& order() const { return m_order; }

  // What lies around the places of a box: its rows of cells are looked up once.
  class Window {
   public:
    Window(const ParticleCells& cells, const openvdb::Vec3d& low, const openvdb::Vec3d& high);

    bool empty() const { return m_empty; }
    // Calls visit(n, d, s) for the particles nearer than the reach to x, which lies in the box: n counts in
    // the order of cells, d leads from x to the particle, s = 1 - (|d| / reach)^2.
    template <class Visit>
    void near(const openvdb::Vec3d& x, const Visit& visit) const;

   private:
    std::uint32_t begin(int i, int j, int k) const {
      return m_begin[(std::size_t(i) * m_size[1] + std::size_t(j)) * (m_size[2] + 1) + std::size_t(k)];
    }

    const ParticleCells& m_cells;
    openvdb::Coord m_low;
    std::size_t m_size[3];
    std::vector<std::uint32_t> m_begin;  // of each cell, and behind the last of each row
    bool m_empty = true;
  };

 private:
  openvdb::Coord cellOf(const openvdb::Vec3d& x) const;

  double m_reach;
  openvdb::Vec3d m_origin{0.0};
  std::vector<openvdb::Vec3f> m_points;
  std::vector<std::uint32_t> m_order;
  std::vector<std::uint64_t> m_keys;
};

template <class Visit>
void ParticleCells::Window::near(const openvdb::Vec3d& x, const Visit& visit) const {
  const openvdb::Coord middle = m_cells.cellOf(x) - m_low;
  const double perSquare = 1.0 / (m_cells.m_reach * m_cells.m_reach);
  const int lowK = std::max(middle[2] - 1, 0), highK = std::min(middle[2] + 2, int(m_size[2]));
  for (int i = std::max(middle[0] - 1, 0); i <= middle[0] + 1 && i < int(m_size[0]); ++i)
    for (int j = std::max(middle[1] - 1, 0); j <= middle[1] + 1 && j < int(m_size[1]); ++j)
      for (std::uint32_t n = begin(i, j, lowK), end = begin(i, j, highK); n < end; ++n) {
        const openvdb::Vec3d d = openvdb::Vec3d(m_cells.m_points[n]) - x;
        const double s = 1.0 - d.lengthSqr() * perSquare;
        if (s > 0.0) visit(n, d, s);
      }
}

}  // namespace fluidtex::caches
