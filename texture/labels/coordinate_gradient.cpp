#include "texture/labels/coordinate_gradient.h"

#include "texture/labels/labels.h"
#include "texture/loops/parallel.h"

#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr float kLargest = 4.0f;  // largest distortion of a proposed gradient
constexpr float kAgree = 0.5f;    // texels: deviation up to which a neighbour agrees

struct Edge {
  Vec2f local, texel;
};

std::optional<Jacobian> through(const Edge& a, const Edge& b) {
  const float det = a.local[0] * b.local[1] - a.local[1] * b.local[0];
  if (std::abs(det) < 1e-3f) return std::nullopt;
  Jacobian j;
  for (int row = 0; row < 2; ++row) {
    j[std::size_t(2 * row)] = (a.texel[row] * b.local[1] - b.texel[row] * a.local[1]) / det;
    j[std::size_t(2 * row + 1)] = (b.texel[row] * a.local[0] - a.texel[row] * b.local[0]) / det;
  }
  if (distortion(j) > kLargest) return std::nullopt;
  return j;
}

// Least squares over the edges that agree with `guess`.
Jacobian refined(const std::vector<Edge>& edges, const Jacobian& guess) {
  double xx = 0.0, xy = 0.0, yy = 0.0, right[4] = {};
  for (const Edge& edge : edges) {
    if ((edge.texel - times(guess, edge.local)).length() >= kAgree) continue;
    const double x = edge.local[0], y = edge.local[1];
    xx += x * x, xy += x * y, yy += y * y;
    for (int row = 0; row < 2; ++row) {
      right[2 * row] += x * edge.texel[row];
      right[2 * row + 1] += y * edge.texel[row];
    }
  }
  const double det = xx * yy - xy * xy;
  if (det < 1e-6) return guess;
  Jacobian j;
  for (int row = 0; row < 2; ++row) {
    j[std::size_t(2 * row)] = float((right[2 * row] * yy - right[2 * row + 1] * xy) / det);
    j[std::size_t(2 * row + 1)] = float((right[2 * row + 1] * xx - right[2 * row] * xy) / det);
  }
  return j;
}

}  // namespace

Vec2f Coordinates::difference(const Vec2f& a, const Vec2f& b) const {
  Vec2f d = a - b;
  if (toroidal) {
    const float size[2] = {float(surface.exemplarWidth), float(surface.exemplarHeight)};
    for (int i = 0; i < 2; ++i) d[i] -= size[i] * std::round(d[i] / size[i]);
  }
  return d;
}

Vec2f Coordinates::local(std::uint32_t v, const Vec3f& x) const {
  const Vec3f from = (x - surface.positions[v]) / float(surface.spacingAt(v));
  const Vec3f& d = surface.orientation[v];
  return {from.dot(d), from.dot(rowAxis(d, surface.normals[v]))};
}

float distortion(const Jacobian& j) {
  // Singular values from the conformal and the anticonformal part.
  const float same = std::hypot(j[0] + j[3], j[2] - j[1]), mirrored = std::hypot(j[0] - j[3], j[2] + j[1]);
  const float s1 = 0.5f * (same + mirrored), s2 = 0.5f * std::abs(same - mirrored);
  return s2 > 0.0f ? std::max(s1, 1.0f / s2) : std::numeric_limits<float>::infinity();
}

std::vector<std::optional<Jacobian>> fittedGradients(const Coordinates& coordinates) {
  const TexturedSurface& surface = coordinates.surface;
  std::vector<std::optional<Jacobian>> result(surface.positions.size());
  forEachIndex(result.size(), [&](std::uint32_t v) {
    std::vector<Edge> edges;
    for (const std::uint32_t u : coordinates.graph.around(v))
      edges.push_back({coordinates.local(v, surface.positions[u]),
                       coordinates.difference(surface.coordinate[u], surface.coordinate[v])});
    std::pair<int, float> best{0, 0.0f};  // how many agree, then minus their total deviation
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto j = through(edges[i], edges[(i + 1) % edges.size()]);
      if (!j) continue;
      std::pair<int, float> score{0, 0.0f};
      for (const Edge& edge : edges) {
        const float off = (edge.texel - times(*j, edge.local)).length();
        if (off >= kAgree) continue;
        ++score.first;
        score.second -= off;
      }
      if (score <= best) continue;
      best = score;
      result[v] = j;
    }
    if (result[v]) result[v] = refined(edges, *result[v]);
  });
  return result;
}

bool cohere(const Coordinates& coordinates, const std::vector<std::optional<Jacobian>>& gradient,
            std::uint32_t v, std::uint32_t u) {
  if (!gradient[v] || !gradient[u]) return false;
  const TexturedSurface& surface = coordinates.surface;
  const auto off = [&](std::uint32_t from, std::uint32_t to) {
    const Vec2f found = coordinates.difference(surface.coordinate[to], surface.coordinate[from]);
    return (found - times(*gradient[from], coordinates.local(from, surface.positions[to]))).length();
  };
  return 0.5f * (off(v, u) + off(u, v)) < kCoherent;
}

}  // namespace fluidtex::texture
