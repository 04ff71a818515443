// Cubic triangle: Farin, Triangular Bernstein-Bezier Patches (1986); its middle point has quadratic
// precision.
#include "transport/cubic_directions.h"

#include "texture/loops/parallel.h"
#include "texture/orientation/tangent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fluidtex::transport {
namespace {

// The fit over a ring smooths the slope by h^2/8 of its Laplacian; a mean over the ring differs from it by
// h^2/4.
constexpr float kSharpen = 0.5f;
constexpr int kSharpenSweeps = 2;
// Share of the period: a larger turn to a neighbour indicates a singularity, where the angle has no slope.
constexpr float kMostTurn = 0.25f;
// Radians: bound on the cubic's deviation from the linear interpolant, since slopes are unreliable beside
// singularities.
constexpr float kMostBend = 0.3f;

// One-rings, unordered.
struct Rings {
  std::vector<std::uint32_t> first, neighbor;
};

// On a closed, oriented mesh each neighbour follows its vertex in exactly one triangle.
Rings ringsOf(const TexturedSurface& surface) {
  Rings rings;
  rings.first.assign(surface.positions.size() + 1, 0);
  rings.neighbor.resize(3 * surface.triangles.size());
  for (const Vec3I& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) ++rings.first[t[i] + 1];
  }
  for (std::size_t v = 1; v < rings.first.size(); ++v) rings.first[v] += rings.first[v - 1];
  std::vector<std::uint32_t> next(rings.first.begin(), rings.first.end() - 1);
  for (const Vec3I& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) rings.neighbor[next[t[i]]++] = t[(i + 1) % 3];
  }
  return rings;
}

// Parallel transport of x from the tangent plane of `from` to that of `to`; x itself where they are nearly
// opposite.
Vec3f turned(const Vec3f& x, const Vec3f& from, const Vec3f& to) {
  return from.dot(to) > -0.9f ? texture::turnedTangent(x, from, to) : x;
}

// Angle from a to b about n, counter-clockwise, smallest up to multiples of `period`.
float angleBetween(const Vec3f& a, const Vec3f& b, const Vec3f& n, float period) {
  const float angle = std::atan2(n.dot(a.cross(b)), a.dot(b));
  return angle - period * std::round(angle / period);
}

float periodOf(int symmetry) {
  return 2.0f * std::numbers::pi_v<float> / float(symmetry);
}

Vec3f fittedSlope(const TexturedSurface& surface, const Rings& rings, std::uint32_t v, float period) {
  const Vec3f &n = surface.normals[v], &d = surface.orientation[v], across = n.cross(d);
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, xa = 0.0f, ya = 0.0f;
  for (std::uint32_t i = rings.first[v]; i < rings.first[v + 1]; ++i) {
    const std::uint32_t u = rings.neighbor[i];
    const Vec3f edge = surface.positions[u] - surface.positions[v];
    const float x = edge.dot(d), y = edge.dot(across);
    const float angle = angleBetween(d, turned(surface.orientation[u], surface.normals[u], n), n, period);
    if (std::abs(angle) > kMostTurn * period) return Vec3f(0.0f);
    xx += x * x, xy += x * y, yy += y * y;
    xa += x * angle, ya += y * angle;
  }
  const float det = xx * yy - xy * xy, sum = xx + yy;
  if (!(det > 1e-3f * sum * sum)) return Vec3f(0.0f);
  return d * ((yy * xa - xy * ya) / det) + across * ((xx * ya - xy * xa) / det);
}

}  // namespace

std::vector<Vec3f> angleSlopes(const TexturedSurface& surface, int symmetry) {
  const Rings rings = ringsOf(surface);
  const float period = periodOf(symmetry);
  std::vector<Vec3f> fitted(surface.positions.size());
  texture::forEachIndex(fitted.size(),
                        [&](std::uint32_t v) { fitted[v] = fittedSlope(surface, rings, v, period); });
  std::vector<Vec3f> slopes = fitted, next(slopes.size());
  for (int sweep = 0; sweep < kSharpenSweeps; ++sweep) {
    texture::forEachIndex(slopes.size(), [&](std::uint32_t v) {
      const std::uint32_t begin = rings.first[v], end = rings.first[v + 1];
      next[v] = fitted[v];
      if (fitted[v] == Vec3f(0.0f)) return;
      Vec3f mean(0.0f);
      for (std::uint32_t i = begin; i < end; ++i) mean += slopes[rings.neighbor[i]];
      mean /= float(end - begin);
      mean -= surface.normals[v] * surface.normals[v].dot(mean);
      next[v] = fitted[v] + (slopes[v] - mean) * kSharpen;
    });
    slopes.swap(next);
  }
  return slopes;
}

Vec3f directionAt(const TexturedSurface& surface, const std::vector<Vec3f>& slopes, const Landing& landing,
                  int symmetry) {
  const Vec3f& n = landing.normal;
  const float period = periodOf(symmetry);
  const auto cornerDirection = [&](int i) {
    const std::uint32_t u = landing.corners[i];
    return turned(surface.orientation[u], surface.normals[u], n);
  };
  const Vec3f base =
      texture::tangentUnit(cornerDirection(landing.nearest), n, cornerDirection(landing.nearest));
  std::array<float, 3> angle{};
  for (int i = 0; i < 3; ++i) {
    if (i != landing.nearest) angle[std::size_t(i)] = angleBetween(base, cornerDirection(i), n, period);
  }
  const Vec3f& w = landing.point.weight;
  float linear = 0.0f, cubic = 0.0f, edges = 0.0f, corners = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float a = angle[std::size_t(i)];
    const std::uint32_t u = landing.corners[i];
    linear += w[i] * a;
    cubic += w[i] * w[i] * w[i] * a;
    corners += a / 3.0f;
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const Vec3f edge = surface.positions[landing.corners[j]] - surface.positions[u];
      const float control = a + slopes[u].dot(edge) / 3.0f;
      edges += control / 6.0f;
      cubic += 3.0f * w[i] * w[i] * w[j] * control;
    }
  }
  cubic += 6.0f * w[0] * w[1] * w[2] * (edges + 0.5f * (edges - corners));
  const float bent = linear + std::clamp(cubic - linear, -kMostBend, kMostBend);
  return base * std::cos(bent) + n.cross(base) * std::sin(bent);
}

}  // namespace fluidtex::transport
