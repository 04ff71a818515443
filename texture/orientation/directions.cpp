#include "texture/orientation/directions.h"

#include "texture/loops/parallel.h"
#include "texture/orientation/tangent_field.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Tangent part of a unit vector, with the square of its length: low confidence where the surface nearly faces
// it.
Vec3f tangentPart(const Vec3f& x, const Vec3f& n) {
  const Vec3f tangent = x - n * n.dot(x);
  return tangent * tangent.length();
}

// Principal direction of larger absolute curvature as a line (N = 2 of tangent_field.h); its length is the
// difference of the absolute curvatures, 1/m.
Complexf bendAt(const SurfaceMesh& mesh, const VertexGraph& graph, std::uint32_t v, const Vec3f& axis) {
  // Least squares for the shape operator [a b; b c], which maps edges to differences of the normal.
  const Vec3f &x = mesh.positions[v], &n = mesh.normals[v];
  const Vec3f across = rowAxis(axis, n);
  double xx = 0.0, xy = 0.0, yy = 0.0, px = 0.0, qy = 0.0, mixed = 0.0;
  for (const std::uint32_t u : graph.around(v)) {
    const Vec3f edge = mesh.positions[u] - x, turn = mesh.normals[u] - n;
    const double ex = edge.dot(axis), ey = edge.dot(across), p = turn.dot(axis), q = turn.dot(across);
    xx += ex * ex;
    xy += ex * ey;
    yy += ey * ey;
    px += p * ex;
    qy += q * ey;
    mixed += p * ey + q * ex;
  }
  const openvdb::math::Mat3d normal(xx, xy, 0.0, xy, xx + yy, xy, 0.0, xy, yy);
  const double size = xx + yy;
  if (!(normal.det() > 1e-9 * size * size * size)) return {};
  const openvdb::Vec3d s = normal.inverse() * openvdb::Vec3d(px, mixed, qy);
  const double mean = 0.5 * (s[0] + s[2]);
  const std::complex<double> difference(0.5 * (s[0] - s[2]), s[1]);
  // Principal curvatures are mean +- |difference|; the larger in magnitude is along +difference where the
  // mean is positive.
  const double length = std::abs(difference);
  if (!(length > 0.0)) return {};
  const double excess = std::abs(mean + length) - std::abs(mean - length);
  return Complexf(difference * (excess / length));
}

}  // namespace

std::vector<Vec3f> alongDirection(const SurfaceMesh& mesh, const Vec3f& direction) {
  const float length = direction.length();
  std::vector<Vec3f> result(mesh.positions.size(), Vec3f(0.0f));
  if (!(length > 0.0f)) return result;
  const Vec3f unit = direction / length;
  forEachIndex(result.size(), [&](std::uint32_t v) { result[v] = tangentPart(unit, mesh.normals[v]); });
  return result;
}

std::vector<Vec3f> alongFlow(const SurfaceMesh& mesh, const std::vector<Vec3f>& velocity, double still) {
  std::vector<Vec3f> result(mesh.positions.size());
  const auto still2 = static_cast<float>(still * still);
  forEachIndex(result.size(), [&](std::uint32_t v) {
    const Vec3f& n = mesh.normals[v];
    const Vec3f tangent = velocity[v] - n * n.dot(velocity[v]);
    const float speed = tangent.length();
    result[v] = tangent * (speed / (speed * speed + still2));
  });
  return result;
}

std::vector<Vec3f> alongBend(const SurfaceMesh& mesh) {
  constexpr int kAverages = 2;
  // Spacings: radii larger than this have less than half of the confidence.
  constexpr float kFarRadius = 20.0f;
  const VertexGraph graph = buildVertexGraph(mesh);
  const std::vector<Vec3f> axes = referenceVectors(mesh.normals);
  const FieldGraph lines = fieldGraph(graph, buildConnection(mesh, graph, axes), 2);
  std::vector<Complexf> bend(mesh.positions.size()), next(bend.size());
  forEachIndex(bend.size(), [&](std::uint32_t v) { bend[v] = bendAt(mesh, graph, v, axes[v]); });
  for (int n = 0; n < kAverages; ++n) {
    forEachIndex(bend.size(), [&](std::uint32_t v) { next[v] = average(lines, bend, v); });
    bend.swap(next);
  }
  std::vector<Vec3f> result(bend.size());
  forEachIndex(result.size(), [&](std::uint32_t v) {
    const float strength = std::abs(bend[v]) * static_cast<float>(mesh.spacingAt(v)) * kFarRadius;
    const Complexf line = std::polar(strength / (1.0f + strength), 0.5f * std::arg(bend[v]));
    result[v] = axes[v] * line.real() + rowAxis(axes[v], mesh.normals[v]) * line.imag();
  });
  return result;
}

std::vector<Vec3f> alongVectors(const SurfaceMesh& mesh, const std::vector<Vec3f>& vectors) {
  std::vector<Vec3f> result(mesh.positions.size(), Vec3f(0.0f));
  forEachIndex(result.size(), [&](std::uint32_t v) {
    const float length = vectors[v].length();
    if (std::isfinite(length) && length > 0.0f) result[v] = tangentPart(vectors[v] / length, mesh.normals[v]);
  });
  return result;
}

std::vector<Vec3f> alongField(const SurfaceMesh& mesh, const openvdb::Vec3SGrid& field) {
  std::vector<Vec3f> vectors(mesh.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vectors.size(), kGrain), [&](const auto& range) {
    const auto accessor = field.getConstAccessor();
    for (std::size_t v = range.begin(); v != range.end(); ++v)
      vectors[v] =
          openvdb::tools::BoxSampler::sample(accessor, field.worldToIndex(openvdb::Vec3d(mesh.positions[v])));
  });
  return alongVectors(mesh, vectors);
}

}  // namespace fluidtex::texture
