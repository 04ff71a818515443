// Flattens pieces of a surface around a vertex, by parallel transport of the centre's frame. [Kwatra07 sec.
// V-A] follows the orientation field instead, and reports that to be unstable near singularities.
#pragma once

#include "texture/loops/complex.h"
#include "texture/neighborhood/neighborhood.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <vector>

namespace fluidtex::texture {

using Complexd = std::complex<double>;

// Flattens one neighbourhood after the other. Arrays over all vertices are reused, by a stamp.
class Flattener {
 public:
  explicit Flattener(const MeshView& view)
      : m_view(view), m_stamp(view.mesh.positions.size(), 0), m_slot(view.mesh.positions.size()) {}

  struct Placed {
    std::uint32_t vertex;
    Complexd l;
    Complexd turn;
  };

  // Flattens everything within `half` spacings of the centre. Then placed() holds the piece, in spacings, and
  // reach() the distance up to which it is valid.
  void flatten(std::uint32_t center, double half) {
    m_half = half;
    place(center);
    relax();  // one sweep: more hardly improve edges
    findReach();
  }

  const std::vector<Placed>& placed() const { return m_placed; }
  double reach() const { return m_reach; }

  // Fills the pixels of a window from the flattened triangles, or from the nearest members where the view has
  // members. pixels: window^2, default-constructed.
  void rasterize(int window, PixelSource* pixels) const {
    m_view.members ? fromNearest(window, pixels) : fromTriangles(window, pixels);
  }

 private:
  // Spacings. Vertices are placed this far beyond the window, so that pixels at its edge find their
  // triangles.
  static constexpr double kMargin = 0.7;
  // A flattened triangle whose area over its area in space is outside [1 / kMaxAreaChange, kMaxAreaChange]
  // ends the neighbourhood. kAreaSlack, pixels^2: tolerance for slivers, whose ratio is meaningless.
  static constexpr double kMaxAreaChange = 3.0;
  static constexpr double kAreaSlack = 0.02;
  // Spacings: a neighbourhood has at least its one-ring.
  static constexpr double kLeastReach = 1.5;

  static double chebyshev(const Complexd& l) { return std::max(std::abs(l.real()), std::abs(l.imag())); }

  void fromTriangles(int window, PixelSource* pixels) const;
  void fromNearest(int window, PixelSource* pixels) const;

  // Turn of a vertex as predicted by its neighbour over half-edge h; h is the vertex's own.
  Complexd turnThrough(const Placed& neighbor, std::uint32_t h) const {
    return product(neighbor.turn, std::conj(Complexd(m_view.connection.rotation[h])));
  }

  // Mean of the predictions by placed neighbours with a slot below `limit`. False if there are none.
  bool predict(std::uint32_t v, std::uint32_t limit, Placed& result) const {
    const VertexGraph& graph = m_view.graph;
    Complexd turnSum(0.0), lSum(0.0), edgeSum(0.0);
    int count = 0;
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      if (m_stamp[u] != m_current || m_slot[u] >= limit) continue;
      const Placed& neighbor = m_placed[m_slot[u]];
      const Complexd turn = turnThrough(neighbor, h), edge(m_view.connection.edge[h]);
      turnSum += turn;
      lSum += neighbor.l - 0.5 * product(turn, edge);
      edgeSum += edge;
      ++count;
    }
    if (count == 0) return false;
    const double size = std::sqrt(std::norm(turnSum));
    result.turn = size > 1e-9 ? turnSum / size : result.turn;
    result.l = (lSum - 0.5 * product(result.turn, edgeSum)) / double(count);
    return true;
  }

  void add(std::uint32_t v) {
    m_stamp[v] = m_current;
    m_slot[v] = std::uint32_t(m_placed.size());
    m_placed.push_back({v, Complexd(0.0), Complexd(1.0)});
  }

  void place(std::uint32_t center) {
    const VertexGraph& graph = m_view.graph;
    if (++m_current == 0) {
      std::fill(m_stamp.begin(), m_stamp.end(), 0u);
      m_current = 1;
    }
    m_placed.clear();
    add(center);
    std::size_t begin = 0, end = 1;
    while (begin < end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (chebyshev(m_placed[i].l) >= m_half + kMargin) continue;
        for (const std::uint32_t u : graph.around(m_placed[i].vertex))
          if (m_stamp[u] != m_current) add(u);
      }
      for (std::size_t i = end; i < m_placed.size(); ++i)
        predict(m_placed[i].vertex, std::uint32_t(end), m_placed[i]);
      begin = end;
      end = m_placed.size();
    }
  }

  void relax() {
    for (std::size_t i = 1; i < m_placed.size(); ++i) predict(m_placed[i].vertex, kNone, m_placed[i]);
  }

  // Calls body(a, b, c) once with the slots of each flattened triangle, clockwise in (l1, l2).
  template <typename Body>
  void forEachTriangle(const Body& body) const {
    for (std::uint32_t i = 0; i < m_placed.size(); ++i) {
      const auto ring = m_view.graph.around(m_placed[i].vertex);
      std::uint32_t last = slotOf(ring.back());
      for (const std::uint32_t u : ring) {
        const std::uint32_t next = slotOf(u);
        if (last > i && next > i && last != kNone && next != kNone) body(i, last, next);
        last = next;
      }
    }
  }
  std::uint32_t slotOf(std::uint32_t v) const { return m_stamp[v] == m_current ? m_slot[v] : kNone; }

  double flatArea(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Complexd u = m_placed[b].l - m_placed[a].l, v = m_placed[c].l - m_placed[a].l;
    return 0.5 *
           (u.imag() * v.real() - u.real() * v.imag());  // rows run downwards: positive seen from outside
  }

  void findReach() {
    const std::vector<Vec3f>& x = m_view.mesh.positions;
    m_reach = m_half;
    forEachTriangle([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const double nearest =
          std::min({chebyshev(m_placed[a].l), chebyshev(m_placed[b].l), chebyshev(m_placed[c].l)});
      if (nearest >= m_reach) return;
      const Vec3f& origin = x[m_placed[a].vertex];
      const double pixel = m_view.mesh.spacingAt(m_placed[a].vertex);
      const double area = 0.5 / (pixel * pixel) *
                          (x[m_placed[b].vertex] - origin).cross(x[m_placed[c].vertex] - origin).length();
      const double flat = flatArea(a, b, c);
      if (flat * kMaxAreaChange < area - kAreaSlack || flat > kMaxAreaChange * area + kAreaSlack)
        m_reach = nearest;
    });
    m_reach = std::max(m_reach, std::min(kLeastReach, m_half));
  }

  MeshView m_view;
  std::vector<std::uint32_t> m_stamp, m_slot;
  std::uint32_t m_current = 0;
  std::vector<Placed> m_placed;
  double m_half = 0.0, m_reach = 0.0;
};

}  // namespace fluidtex::texture
