// Flattening by parallel transport of the centre's frame; [Kwatra07 sec. V-A] flattens by following the
// orientation field instead, which it reports to be unstable near the field's singularities.
#include "texture/neighborhood.h"

#include "texture/complex.h"
#include "texture/parallel.h"
#include "texture/random.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

using Complexd = std::complex<double>;

constexpr int kRelaxationSweeps = 2;
// Vertices are placed this far beyond the window, so that the pixels at its edge find their triangles.
constexpr double kMargin = 0.7;
// Areas of flattened triangles over their areas in space outside [1 / kMaxAreaChange, kMaxAreaChange] end a
// neighbourhood; kAreaSlack, pixels^2, forgives slivers, whose ratio says nothing.
constexpr double kMaxAreaChange = 3.0;
constexpr double kAreaSlack = 0.02;
// No neighbourhood becomes smaller than its first ring.
constexpr double kLeastReach = 1.5;
// Reach, in pixels, of the small neighbourhoods that fill the gaps between shrunk ones.
constexpr double kFillerReach = 4.5;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

double chebyshev(const Complexd& l) {
  return std::max(std::abs(l.real()), std::abs(l.imag()));
}

// Flattens one neighbourhood after the other; arrays over all vertices are reused, told apart by a stamp.
class Flattener {
 public:
  explicit Flattener(const MeshView& view)
      : m_view(view), m_stamp(view.mesh.positions.size(), 0), m_slot(view.mesh.positions.size()) {}

  struct Placed {
    std::uint32_t vertex;
    Complexd l;
    Complexd turn;
  };

  // Flattens all within `half` spacings of the centre. Afterwards placed() holds the piece, in spacings, and
  // reach() how far it can be trusted.
  void flatten(std::uint32_t center, double half) {
    m_half = half;
    place(center);
    for (int sweep = 0; sweep < kRelaxationSweeps; ++sweep) relax();
    findReach();
  }

  const std::vector<Placed>& placed() const { return m_placed; }
  double reach() const { return m_reach; }

  // Fills the window's pixels from the flattened triangles; where only some vertices are members, from the
  // nearest of those. `pixels`: window^2, as they come from their constructor.
  void rasterize(int window, PixelSource* pixels) const {
    m_view.members ? fromNearest(window, pixels) : fromTriangles(window, pixels);
  }

 private:
  void fromTriangles(int window, PixelSource* pixels) const;
  void fromNearest(int window, PixelSource* pixels) const;

  // The turn of a vertex as its neighbour over edge h has it; h is the vertex's own.
  Complexd turnThrough(const Placed& neighbor, std::uint32_t h) const {
    return product(neighbor.turn, std::conj(Complexd(m_view.connection.rotation[h])));
  }

  // Averages what the placed neighbours with a slot below `limit` predict. False if there are none.
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

  // Calls body(a, b, c) with the slots of every flattened triangle, once each, clockwise in (l1, l2).
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

void Flattener::fromTriangles(int window, PixelSource* pixels) const {
  constexpr double kOnEdge =
      1e-7;  // a pixel on an edge belongs to either triangle; weights are cut off at zero
  const int radius = window / 2;
  const double limit = m_reach - 0.5 + 1e-6;  // where the neighbourhood is whole this is the radius
  forEachTriangle([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Complexd p[3] = {m_placed[a].l, m_placed[b].l, m_placed[c].l};
    const auto [left, right] = std::minmax({p[0].real(), p[1].real(), p[2].real()});
    const auto [top, bottom] = std::minmax({p[0].imag(), p[1].imag(), p[2].imag()});
    const int i0 = std::max(-radius, int(std::ceil(left - kOnEdge)));
    const int i1 = std::min(radius, int(std::floor(right + kOnEdge)));
    const int j0 = std::max(-radius, int(std::ceil(top - kOnEdge)));
    const int j1 = std::min(radius, int(std::floor(bottom + kOnEdge)));
    if (i0 > i1 || j0 > j1) return;
    const double area = flatArea(a, b, c);
    if (area <= 1e-12) return;
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        if (std::max(std::abs(i), std::abs(j)) > limit) continue;
        PixelSource& pixel = pixels[std::size_t(j + radius) * window + (i + radius)];
        if (!pixel.missing()) continue;
        const Complexd x(i, j);
        double weight[3];
        for (int k = 0; k < 3; ++k) {
          const Complexd u = p[(k + 1) % 3] - x, v = p[(k + 2) % 3] - x;
          weight[k] = 0.5 * (u.imag() * v.real() - u.real() * v.imag()) / area;
        }
        if (std::min({weight[0], weight[1], weight[2]}) < -kOnEdge) continue;
        for (double& w : weight) w = std::max(w, 0.0);
        const double sum = weight[0] + weight[1] + weight[2];
        pixel.vertex = {m_placed[a].vertex, m_placed[b].vertex, m_placed[c].vertex};
        pixel.weight = {float(weight[0] / sum), float(weight[1] / sum), float(weight[2] / sum)};
      }
    }
  });
}

// The three nearest members, each the more the nearer it is.
void Flattener::fromNearest(int window, PixelSource* pixels) const {
  constexpr double kFarthest = 1.6;  // pixels
  const int radius = window / 2;
  const double limit = m_reach / double(m_view.pixel) - 0.5 + 1e-6;
  for (const Placed& placed : m_placed) {
    if (!m_view.isMember(placed.vertex)) continue;
    const Complexd l = placed.l / double(m_view.pixel);
    const int i0 = std::max(-radius, int(std::ceil(l.real() - kFarthest)));
    const int i1 = std::min(radius, int(std::floor(l.real() + kFarthest)));
    const int j0 = std::max(-radius, int(std::ceil(l.imag() - kFarthest)));
    const int j1 = std::min(radius, int(std::floor(l.imag() + kFarthest)));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const double distance = std::norm(l - Complexd(i, j));
        if (std::max(std::abs(i), std::abs(j)) > limit || distance > kFarthest * kFarthest) continue;
        PixelSource& pixel = pixels[std::size_t(j + radius) * window + (i + radius)];
        std::uint32_t vertex = placed.vertex;
        auto weight = float(1.0 / (distance + 0.05));
        for (int k = 0; k < 3; ++k)
          if (weight > pixel.weight[k])
            std::swap(weight, pixel.weight[k]), std::swap(vertex, pixel.vertex[k]);
      }
  }
  for (int i = 0; i < window * window; ++i) {
    PixelSource& pixel = pixels[i];
    if (pixel.missing()) continue;
    const float sum = pixel.weight[0] + pixel.weight[1] + pixel.weight[2];
    for (float& w : pixel.weight) w /= sum;
  }
}

void append(Neighborhoods& to, const Neighborhoods& more) {
  const std::uint32_t base = to.first.back();
  to.center.insert(to.center.end(), more.center.begin(), more.center.end());
  to.reach.insert(to.reach.end(), more.reach.begin(), more.reach.end());
  for (std::size_t p = 0; p < more.size(); ++p) to.first.push_back(base + more.first[p + 1]);
  to.vertex.insert(to.vertex.end(), more.vertex.begin(), more.vertex.end());
  to.offset.insert(to.offset.end(), more.offset.begin(), more.offset.end());
  to.turn.insert(to.turn.end(), more.turn.begin(), more.turn.end());
}

}  // namespace

std::vector<std::uint32_t> selectCenters(const MeshView& view, float radius,
                                         const std::vector<std::uint8_t>& wanted) {
  const std::vector<Vec3f>& x = view.mesh.positions;
  const std::size_t count = x.size();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(count);
  for (std::uint32_t v = 0; v < count; ++v)
    if (view.isMember(v) && (wanted.empty() || wanted[v])) order.emplace_back(mix64(v), v);
  std::sort(order.begin(), order.end());

  std::vector<std::uint32_t> centers, queue;
  std::vector<std::uint8_t> covered(count, 0);
  std::vector<std::uint32_t> visited(count, kNone);
  for (const auto& entry : order) {
    const std::uint32_t center = entry.second;
    if (covered[center]) continue;
    centers.push_back(center);
    const auto reach = float(radius * view.pixel * view.mesh.spacingAt(center));
    queue.assign(1, center);
    visited[center] = center;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      covered[queue[i]] = 1;
      for (const std::uint32_t u : view.graph.around(queue[i])) {
        if (visited[u] == center || (x[u] - x[center]).lengthSqr() > reach * reach) continue;
        visited[u] = center;
        queue.push_back(u);
      }
    }
  }
  std::sort(centers.begin(), centers.end());  // neighbours in memory are near each other on most meshes
  return centers;
}

namespace {

// One a thread; their arrays over all vertices are worth keeping from one call to the next.
using Flatteners = tbb::enumerable_thread_specific<Flattener>;

Flatteners makeFlatteners(const MeshView& view) {
  return Flatteners([view] { return Flattener(view); });
}

Neighborhoods build(const MeshView& view, Flatteners& flatteners, int window,
                    std::vector<std::uint32_t> centers, PixelNeighborhoods* pixels,
                    double widest = std::numeric_limits<double>::infinity()) {
  if (window < 3 || window % 2 == 0)
    throw std::invalid_argument("the width of a window must be odd and at least 3");
  constexpr std::size_t kChunk = 64;
  Neighborhoods result;
  result.window = window;
  result.center = std::move(centers);
  const std::size_t count = result.size(), chunks = (count + kChunk - 1) / kChunk;
  result.reach.resize(count);
  result.first.assign(count + 1, 0);
  const std::size_t area = std::size_t(window) * window;
  const double pixel = double(view.pixel);
  if (pixels) pixels->assign(count * area, PixelSource{});

  struct Piece {
    std::vector<std::uint32_t> vertex;
    std::vector<Vec2f> offset;
    std::vector<Complexf> turn;
  };
  std::vector<Piece> pieces(chunks);
  tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
    Flattener& flattener = flatteners.local();
    Piece& piece = pieces[chunk];
    for (std::size_t p = chunk * kChunk; p < std::min(count, (chunk + 1) * kChunk); ++p) {
      flattener.flatten(result.center[p], pixel * std::min(0.5 * window, widest));
      result.reach[p] = float(flattener.reach() / pixel);
      const std::size_t before = piece.vertex.size();
      for (const Flattener::Placed& placed : flattener.placed()) {
        const Vec2f l(float(placed.l.real() / pixel), float(placed.l.imag() / pixel));
        if (!view.isMember(placed.vertex)) continue;
        if (std::max(std::abs(l[0]), std::abs(l[1])) >= result.reach[p]) continue;
        piece.vertex.push_back(placed.vertex);
        piece.offset.push_back(l);
        piece.turn.emplace_back(placed.turn);
      }
      result.first[p + 1] = std::uint32_t(piece.vertex.size() - before);
      if (pixels) flattener.rasterize(window, pixels->data() + p * area);
    }
  });

  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.vertex.resize(result.first.back());
  result.offset.resize(result.first.back());
  result.turn.resize(result.first.back());
  tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
    const Piece& piece = pieces[chunk];
    const std::uint32_t at = result.first[chunk * kChunk];
    std::copy(piece.vertex.begin(), piece.vertex.end(), result.vertex.begin() + at);
    std::copy(piece.offset.begin(), piece.offset.end(), result.offset.begin() + at);
    std::copy(piece.turn.begin(), piece.turn.end(), result.turn.begin() + at);
  });
  return result;
}

}  // namespace

Neighborhoods buildNeighborhoods(const MeshView& view, int window, std::vector<std::uint32_t> centers,
                                 PixelNeighborhoods* pixels, double widest) {
  Flatteners flatteners = makeFlatteners(view);
  return build(view, flatteners, window, std::move(centers), pixels, widest);
}

Neighborhoods coverSurface(const MeshView& view, int window, const std::vector<std::uint8_t>& wanted,
                           PixelNeighborhoods* pixels) {
  Flatteners flatteners = makeFlatteners(view);
  Neighborhoods result =
      build(view, flatteners, window, selectCenters(view, 0.25f * float(window), wanted), pixels);
  const std::size_t count = view.mesh.positions.size();
  // A shrunk neighbourhood may not reach all that its centre was to cover; the second radius makes every
  // vertex its own. Where those are needed nothing wide can be flattened, so that nothing wide is tried.
  for (const float radius : {1.0f, 0.0f}) {
    std::vector<std::uint8_t> open = wanted.empty() ? std::vector<std::uint8_t>(count, 1) : wanted;
    for (const std::uint32_t v : result.vertex) open[v] = 0;
    if (view.members)
      for (std::uint32_t v = 0; v < count; ++v) open[v] = open[v] && view.isMember(v);
    if (std::find_if(open.begin(), open.end(), [](std::uint8_t o) { return o != 0; }) == open.end()) break;
    PixelNeighborhoods morePixels;
    append(result, build(view, flatteners, window, selectCenters(view, radius, open),
                         pixels ? &morePixels : nullptr, kFillerReach));
    if (pixels) pixels->insert(pixels->end(), morePixels.begin(), morePixels.end());
  }
  return result;
}

Overlaps overlaps(const Neighborhoods& neighborhoods, std::size_t vertexCount) {
  Overlaps result;
  result.first.assign(vertexCount + 1, 0);
  for (const std::uint32_t v : neighborhoods.vertex) ++result.first[v + 1];
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.window.resize(neighborhoods.vertex.size());
  result.entry.resize(neighborhoods.vertex.size());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) {
    for (std::uint32_t i = neighborhoods.first[p]; i < neighborhoods.first[p + 1]; ++i) {
      const std::uint32_t at = next[neighborhoods.vertex[i]]++;
      result.window[at] = p;
      result.entry[at] = i;
    }
  }
  return result;
}

WindowLinks linkWindows(const Neighborhoods& neighborhoods, std::size_t vertexCount, int limit) {
  std::vector<std::uint32_t> windowAt(vertexCount, kNone);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) windowAt[neighborhoods.center[p]] = p;
  WindowLinks links;
  links.first.push_back(0);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) {
    int found = 0;
    for (std::uint32_t i = neighborhoods.first[p] + 1; i < neighborhoods.first[p + 1] && found < limit; ++i) {
      const std::uint32_t other = windowAt[neighborhoods.vertex[i]];
      if (other == kNone) continue;
      links.window.push_back(other);
      links.entry.push_back(i);
      ++found;
    }
    links.first.push_back(std::uint32_t(links.window.size()));
  }
  return links;
}

}  // namespace fluidtex::texture
