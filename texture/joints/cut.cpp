#include "texture/joints/cut.h"

#include "texture/joints/former.h"
#include "texture/loops/parallel.h"
#include "texture/vertex_arrays.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <type_traits>

namespace fluidtex::texture {
namespace {

// By how many repetitions of a toroidal exemplar coordinates are shifted: shown, former.
using Shift = std::array<std::int16_t, 4>;

// A vertex of the cut surface: where it lies, and the old vertex whose side it is on.
struct NewVertex {
  Origin origin;
  std::uint32_t side = 0;
  Shift shift{};
};

// An edge with its lower vertex first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeOf(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

class Cutter {
 public:
  Cutter(const TexturedSurface& surface, bool toroidal)
      : m_surface(surface),
        m_torus(surface, toroidal),
        m_shown{surface.coordinate, surface.gradient},
        m_former(formerPlaces(surface)) {}

  CutSurface cut() {
    m_vertices.resize(m_surface.positions.size());
    for (std::uint32_t v = 0; v < m_vertices.size(); ++v) m_vertices[v] = {{{v, v, v}}, v};
    cutEdges();
    for (std::uint32_t t = 0; t < m_surface.triangles.size(); ++t) cutTriangle(t);
    if (m_torus.toroidal) unwrapTriangles();
    return assembled();
  }

 private:
  bool isCut(std::uint32_t a, std::uint32_t b) const {
    return !onePiece(m_torus, m_surface.positions, m_shown, a, b) ||
           (m_former.known[a] && m_former.known[b] &&
            !onePiece(m_torus, m_surface.positions, m_former.places, a, b));
  }

  // Finds the edges to cut, and makes two vertices in the middle of each: the lower end's side, then the
  // other's.
  void cutEdges() {
    m_isCut.resize(m_surface.triangles.size());
    m_cuts = gathered<Edge>(m_surface.triangles.size(), [&](std::uint32_t t, std::vector<Edge>& list) {
      const Vec3I& corner = m_surface.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
        m_isCut[t][std::size_t(k)] = isCut(a, b);
        if (m_isCut[t][std::size_t(k)]) list.push_back(edgeOf(a, b));
      }
    });
    tbb::parallel_sort(m_cuts.begin(), m_cuts.end());
    m_cuts.erase(std::unique(m_cuts.begin(), m_cuts.end()), m_cuts.end());
    m_firstMiddle = std::uint32_t(m_vertices.size());
    for (const auto& [a, b] : m_cuts)
      for (const std::uint32_t side : {a, b}) m_vertices.push_back({{{a, b, b}, {0.5f, 0.5f, 0.0f}}, side});
  }

  // The vertex in the middle of a cut edge on the side of its end a.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) const {
    const auto found = std::lower_bound(m_cuts.begin(), m_cuts.end(), edgeOf(a, b));
    return m_firstMiddle + 2 * std::uint32_t(found - m_cuts.begin()) + (a > b);
  }

  void put(std::uint32_t t, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m_triangles.emplace_back(a, b, c);
    m_from.push_back(t);
  }

  void cutTriangle(std::uint32_t t) {
    const Vec3I& corner = m_surface.triangles[t];
    const std::array<bool, 3>& cut = m_isCut[t];
    const int count = cut[0] + cut[1] + cut[2];
    if (count == 0) return put(t, corner[0], corner[1], corner[2]);
    // The corners in turn, so that of one cut it is edge ab, of two ab and ca.
    std::size_t first = 0;
    while (count == 1 ? !cut[first] : count == 2 && cut[(first + 1) % 3]) ++first;
    const auto nth = [&](std::size_t k) { return corner[int((first + k) % 3)]; };
    const std::uint32_t a = nth(0), b = nth(1), c = nth(2);
    if (count == 1) {  // a and b hang together through c alone
      put(t, a, middle(a, b), c);
      put(t, middle(b, a), b, c);
    } else if (count == 2) {
      put(t, a, middle(a, b), middle(a, c));
      put(t, middle(b, a), b, c);
      put(t, middle(b, a), c, middle(c, a));
    } else {
      constexpr float kThird = 1.0f / 3.0f;
      const Origin centre{{a, b, c}, {kThird, kThird, kThird}};
      const std::array<std::uint32_t, 3> around{a, b, c};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t own = around[k], next = around[(k + 1) % 3], last = around[(k + 2) % 3];
        const auto point = std::uint32_t(m_vertices.size());
        m_vertices.push_back({centre, own});
        put(t, own, middle(own, next), point);
        put(t, own, point, middle(own, last));
      }
    }
  }

  // Coordinate of a vertex by that of its side's corner, before it is shifted.
  Vec2f placeOf(const Places& places, const NewVertex& vertex) const {
    return continued(m_torus.brought(places.coordinate[vertex.side]), places.gradient[vertex.side],
                     positionOf(vertex.origin) - m_surface.positions[vertex.side]);
  }

  Vec3f positionOf(const Origin& origin) const { return mean(m_surface.positions, origin); }

  template <class Value>
  static Value mean(const std::vector<Value>& values, const Origin& origin) {
    Value sum = values[origin.vertex[0]] * origin.weight[0];
    for (std::size_t k = 1; k < 3; ++k)
      if (origin.weight[k] > 0.0f) sum += values[origin.vertex[k]] * origin.weight[k];
    return sum;
  }

  // Triangles across the edge of a toroidal exemplar get copies of their vertices on the side of the largest
  // coordinate.
  void unwrapTriangles() {
    struct Use {
      std::uint32_t vertex;
      Shift shift;
      std::uint32_t triangle;
      int corner;
    };
    std::vector<Use> uses = gathered<Use>(m_triangles.size(), [&](std::uint32_t t, std::vector<Use>& list) {
      Shift shift[3]{};
      for (const std::size_t layer : {0, 1}) {
        Vec2f q[3];
        for (int k = 0; k < 3; ++k) {
          const NewVertex& vertex = m_vertices[m_triangles[t][k]];
          q[k] = placeOf(layer == 1 && m_former.known[vertex.side] ? m_former.places : m_shown, vertex);
        }
        for (const int axis : {0, 1}) {
          const float largest = std::max({q[0][axis], q[1][axis], q[2][axis]});
          for (int k = 0; k < 3; ++k)
            shift[k][2 * layer + std::size_t(axis)] =
                std::int16_t(std::lround((largest - q[k][axis]) / m_torus.size[axis]));
        }
      }
      for (int k = 0; k < 3; ++k)
        if (shift[k] != Shift{}) list.push_back({m_triangles[t][k], shift[k], t, k});
    });
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
      return std::tie(a.vertex, a.shift, a.triangle) < std::tie(b.vertex, b.shift, b.triangle);
    });
    std::vector<std::uint32_t> unshifted(m_vertices.size());  // by how many corners each is used as it is
    for (const Vec3I& corner : m_triangles)
      for (int k = 0; k < 3; ++k) ++unshifted[corner[k]];
    for (const Use& use : uses) --unshifted[use.vertex];
    std::uint32_t taken = 0;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const Use& use = uses[i];
      const bool first = i == 0 || use.vertex != uses[i - 1].vertex;
      if (first || use.shift != uses[i - 1].shift) {
        // One that no triangle uses as it is takes the first shift itself, or it would be of no triangle.
        taken = use.vertex;
        if (!first || unshifted[use.vertex] > 0) {
          taken = std::uint32_t(m_vertices.size());
          m_vertices.push_back(m_vertices[use.vertex]);
        }
        m_vertices[taken].shift = use.shift;
      }
      m_triangles[use.triangle][use.corner] = taken;
    }
  }

  CutSurface assembled() {
    CutSurface result{m_surface, std::vector<Origin>(m_vertices.size()), std::move(m_from)};
    TexturedSurface& to = result.surface;
    to.triangles = std::move(m_triangles);
    forEachVertexArray(to, [&](auto& values, Array) { extend(values); });
    const std::size_t old = m_surface.positions.size();
    forEachIndex(m_vertices.size(), [&](std::uint32_t v) {
      const NewVertex& vertex = m_vertices[v];
      const std::uint32_t side = vertex.side;
      result.origin[v] = vertex.origin;
      to.coordinate[v] = shifted(placeOf(m_shown, vertex), vertex.shift[0], vertex.shift[1]);
      if (!to.fading.weight.empty()) {
        to.fading.coordinate[v] =
            m_former.known[side] ? shifted(placeOf(m_former.places, vertex), vertex.shift[2], vertex.shift[3])
                                 : to.coordinate[v];
        to.fading.gradient[v] = m_former.places.gradient[side];
      }
      if (v < old) return;
      to.normals[v].normalize(0.0f);
      if (!to.orientation.empty()) to.orientation[v] = m_surface.orientation[side];
      for (auto& [name, values] : to.vectors) values[v] = m_surface.vectors.at(name)[side];
    });
    return result;
  }

  Vec2f shifted(const Vec2f& q, int x, int y) const {
    return {q[0] + float(x) * m_torus.size[0], q[1] + float(y) * m_torus.size[1]};
  }

  // Values of the new vertices behind the old ones: those that have means interpolated, else of the side's
  // corner.
  template <class Value>
  void extend(std::vector<Value>& values) const {
    if (values.empty()) return;
    const std::size_t old = values.size();
    values.resize(m_vertices.size());
    forEachIndex(m_vertices.size() - old, [&](std::uint32_t i) {
      const NewVertex& vertex = m_vertices[old + i];
      if constexpr (std::is_same_v<Value, TexelGradient> || std::is_same_v<Value, std::uint8_t>)
        values[old + i] = values[vertex.side];
      else
        values[old + i] = mean(values, vertex.origin);
    });
  }

  const TexturedSurface& m_surface;
  Torus m_torus;
  Places m_shown;
  Former m_former;
  std::vector<NewVertex> m_vertices;
  std::vector<std::array<bool, 3>> m_isCut;  // of each triangle's edges, from corner k to the next
  std::vector<Edge> m_cuts;                  // ascending
  std::uint32_t m_firstMiddle = 0;
  std::vector<Vec3I> m_triangles;
  std::vector<std::uint32_t> m_from;
};

}  // namespace

CutSurface cutAtJoints(const TexturedSurface& surface, bool toroidal) {
  if (surface.coordinate.size() == surface.positions.size()) return Cutter(surface, toroidal).cut();
  CutSurface result{surface, std::vector<Origin>(surface.positions.size()), {}};
  for (std::uint32_t v = 0; v < result.origin.size(); ++v) result.origin[v] = {{v, v, v}};
  result.triangle.resize(surface.triangles.size());
  std::iota(result.triangle.begin(), result.triangle.end(), 0u);
  return result;
}

}  // namespace fluidtex::texture
