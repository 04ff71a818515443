#include "texture/measure/change.h"

#include "texture/exemplar/srgb.h"
#include "texture/labels/coordinate_gradient.h"
#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"
#include "texture/measure/new_surface.h"
#include "texture/measure/tiles.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kSame = 0.5f;           // texels between a coordinate and the one carried there
constexpr float kStep = 1.0f / 255.0f;  // of a file's colours: smaller differences count as none
// Spacings from the last surface. What was there lies on it; what came in since is off it by more.
constexpr double kThere = 0.25;

// Error of the smooth reading between vertices over the error of reading a vertex from its neighbours,
// measured on sheets whose texture moved exactly.
constexpr double kBetween = 0.57;

double meanDifference(const Vec3f& a, const Vec3f& b) {
  return (std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2])) / 3.0;
}

// Barycentric weights of the triangle's point nearest to x.
Vec3f nearestOnTriangle(const Vec3f& x, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, from = x - a;
  const float d00 = ab.dot(ab), d01 = ab.dot(ac), d11 = ac.dot(ac);
  const float d20 = from.dot(ab), d21 = from.dot(ac), det = d00 * d11 - d01 * d01;
  if (det > 1e-12f * d00 * d11) {
    const float v = (d11 * d20 - d01 * d21) / det, w = (d00 * d21 - d01 * d20) / det;
    if (v >= 0.0f && w >= 0.0f && v + w <= 1.0f) return {1.0f - v - w, v, w};
  }
  const Vec3f corner[3] = {a, b, c};
  Vec3f best(1.0f, 0.0f, 0.0f);
  float least = std::numeric_limits<float>::max();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3f edge = corner[j] - corner[i];
    const float t = std::clamp((x - corner[i]).dot(edge) / std::max(edge.lengthSqr(), 1e-30f), 0.0f, 1.0f);
    const float d = (corner[i] + edge * t - x).lengthSqr();
    if (d >= least) continue;
    least = d;
    best = Vec3f(0.0f);
    best[i] = 1.0f - t;
    best[j] = t;
  }
  return best;
}

// A point on the last surface.
struct Landing {
  Vec3I corner{0u, 0u, 0u};
  Vec3f weight{0.0f};
  std::uint32_t nearest = 0;  // vertex

  template <class Value>
  Value mean(const std::vector<Value>& values) const {
    return values[corner[0]] * weight[0] + values[corner[1]] * weight[1] + values[corner[2]] * weight[2];
  }
};

class LastSurface {
 public:
  explicit LastSurface(const TileGround& ground)
      : m_ground(ground), m_grid(ground.surface.positions, 1.25 * ground.spacing) {
    const TexturedSurface& surface = ground.surface;
    m_first.assign(surface.positions.size() + 1, 0);
    for (const Vec3I& t : surface.triangles)
      for (int i = 0; i < 3; ++i) ++m_first[t[i] + 1];
    for (std::size_t v = 1; v < m_first.size(); ++v) m_first[v] += m_first[v - 1];
    m_triangle.resize(m_first.back());
    std::vector<std::uint32_t> next(m_first.begin(), m_first.end() - 1);
    for (std::uint32_t k = 0; k < surface.triangles.size(); ++k)
      for (int i = 0; i < 3; ++i) m_triangle[next[surface.triangles[k][i]]++] = k;
  }

  // Nothing where the surface is farther away than kThere.
  std::optional<Landing> at(const Vec3f& x) const {
    const TexturedSurface& surface = m_ground.surface;
    const auto limit = float(kThere * kThere * m_ground.spacing * m_ground.spacing);
    std::pair<float, std::uint32_t> triangle{limit, 0}, vertex{std::numeric_limits<float>::max(), 0};
    std::optional<Landing> result;
    const auto distance2 = [&](std::uint32_t v) { return (surface.positions[v] - x).lengthSqr(); };
    m_grid.visitNear(x, [&](std::uint32_t v) {
      const float here = distance2(v);
      vertex = std::min(vertex, {here, v});
      for (std::uint32_t k = m_first[v]; k < m_first[v + 1]; ++k) {
        const Vec3I& t = surface.triangles[m_triangle[k]];
        // Each triangle is tested from the nearest of its corners only.
        bool mine = true;
        for (int i = 0; i < 3; ++i)
          mine = mine && (t[i] == v || std::pair(distance2(t[i]), t[i]) > std::pair(here, v));
        if (!mine) continue;
        const Vec3f w =
            nearestOnTriangle(x, surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]);
        const Landing landing{t, w, 0};
        const std::pair<float, std::uint32_t> found{(landing.mean(surface.positions) - x).lengthSqr(),
                                                    m_triangle[k]};
        if (found >= triangle) continue;
        triangle = found;
        result = landing;
      }
    });
    if (result) result->nearest = vertex.second;
    return result;
  }

 private:
  const TileGround& m_ground;
  PointGrid m_grid;
  std::vector<std::uint32_t> m_first, m_triangle;  // of each vertex
};

// A picture as the exemplar at its coordinates, and its difference from that.
class Picture {
 public:
  Picture(const TexturedSurface& surface, const Image& color, bool toroidal)
      : shown(seenColors(surface)), m_color(color), m_toroidal(toroidal) {
    beside.resize(shown.size());
    forEachIndex(shown.size(), [&](std::uint32_t v) {
      beside[v] = shown[v] - exemplar(surface.coordinate[v]);
      for (int c = 0; c < 3; ++c)
        if (std::abs(beside[v][c]) < kStep) beside[v][c] = 0.0f;
    });
  }

  Vec3f exemplar(const Vec2f& texel) const {
    return seenColor(straight(samplePremultiplied(m_color, m_toroidal, texel)));
  }

  std::vector<Vec3f> shown, beside;

 private:
  const Image& m_color;
  bool m_toroidal;
};

Vec3f readSmooth(const TileGround& ground, const std::vector<Vec3f>& colors, const Vec3f& x, std::uint32_t at,
                 bool withoutIt) {
  SmoothReading found;
  readAt(ground, x, at, withoutIt, found);
  Vec3f sum(0.0f);
  for (const auto& [weight, u] : found) sum += colors[u] * weight;
  return sum;
}

// Error of the reading at vertices that have not moved.
double readingCost(const TileGround& ground, const std::vector<Vec3f>& colors) {
  const double sum = sumOf(colors.size(), [&](std::uint32_t v) {
    return meanDifference(colors[v], readSmooth(ground, colors, ground.surface.positions[v], v, true));
  });
  return kBetween * sum / double(colors.size());
}

}  // namespace

std::optional<Change> measureChange(const TexturedSurface& before, const TexturedSurface& after,
                                    const Image& color, bool toroidal) {
  if (before.empty() || after.empty()) return std::nullopt;
  const TileGround ground(before);
  const LastSurface last(ground);
  const Coordinates coordinates{before, ground.graph, toroidal};
  const auto gradient = fittedGradients(coordinates);
  const Picture was(before, color, toroidal), is(after, color, toroidal);

  struct Vertex {
    bool counts = false, same = true;
    double pop = 0.0, change = 0.0, smooth = 0.0;
    Vec3f from{0.0f};  // the last colour by the smooth reading
  };
  std::vector<Vertex> vertices(after.positions.size());
  forEachIndex(vertices.size(), [&](std::uint32_t v) {
    if (after.trust[v] < kNewSurface) return;
    const auto landing = last.at(after.previousPosition[v]);
    if (!landing) return;
    Vertex& vertex = vertices[v];
    vertex.counts = true;
    vertex.pop = meanDifference(is.shown[v], landing->mean(was.shown));
    vertex.from = readSmooth(ground, was.shown, after.previousPosition[v], landing->nearest, false);
    vertex.smooth = meanDifference(is.shown[v], vertex.from);
    const std::uint32_t corner = landing->nearest;
    Vec2f carried = before.coordinate[corner];
    if (gradient[corner])
      carried += times(*gradient[corner], coordinates.local(corner, after.previousPosition[v]));
    const Vec2f& shown = after.coordinate[v];
    vertex.same = coordinates.difference(shown, carried).length() < kSame;
    const Vec3f now = is.exemplar(shown) + is.beside[v];
    const Vec3f then = is.exemplar(vertex.same ? shown : carried) + landing->mean(was.beside);
    vertex.change = double(luminance(now.asPointer()) - luminance(then.asPointer()));
  });
  Change result;
  std::vector<float> pops;
  std::vector<std::uint32_t> counted;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Vertex& vertex = vertices[v];
    if (!vertex.counts) continue;
    counted.push_back(v);
    pops.push_back(float(vertex.pop));
    result.change += vertex.change * vertex.change;
    result.renewed += !vertex.same;
    result.alongFlow += vertex.smooth;
  }
  if (counted.empty()) return std::nullopt;
  const double count = double(counted.size());
  result.pop = percentile(pops, 0.999);
  result.change = std::sqrt(result.change / count);
  result.renewed /= count;
  result.alongFlow /= count;
  Dice dice(1);
  double shuffled = 0.0;
  for (const std::uint32_t v : counted)
    shuffled += meanDifference(is.shown[v], vertices[counted[dice.below(counted.size())]].from);
  const double cost = readingCost(ground, was.shown);
  result.ratio = (result.alongFlow - cost) / std::max(shuffled / count - cost, 1e-12);
  return result;
}

}  // namespace fluidtex::texture
