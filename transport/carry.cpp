#include "transport/carry.h"

#include "texture/parallel.h"
#include "texture/tangent.h"
#include "transport/backtrace.h"
#include "transport/closest_point.h"
#include "transport/velocity_sampler.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::transport {
namespace {

using texture::Carried;
using texture::SurfaceMesh;
using texture::TexelGradient;
using texture::TexturedSurface;
using texture::Vec2f;
using texture::Vec3f;
using texture::Vec3I;
using texture::Vec4f;

// A triangle that faces the other way is taken only if all that agree are further off by this many scales of
// trust.
constexpr double kOtherSide = 4.0;

Vec3f anyTangent(const Vec3f& n) {
  const Vec3f world = std::abs(n.x()) < 0.9f ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0);
  return (world - n * n.dot(world)).unit();
}

// x^T B for a row vector such as a gradient: (x B)_j = sum_i x_i B_ij.
Vec3f rowTimes(const Vec3f& x, const Mat3d& b) {
  return Vec3f(b.transpose() * Vec3d(x));
}

// adj(B) = det(B) B^-1; defined where B has no inverse too.
Mat3d adjugate(const Mat3d& b) {
  const Vec3d r0 = b.row(0), r1 = b.row(1), r2 = b.row(2);
  Mat3d result;
  result.setColumns(r1.cross(r2), r2.cross(r0), r0.cross(r1));
  return result;
}

// The length over which trust falls off, at least: what separates surfaces is seen neither below half a voxel
// nor below the spacing.
double halfVoxel(const sim::Frame& frame) {
  double voxel = 0.0;
  if (!frame.substeps.empty()) voxel = VelocitySampler(frame.substeps.back()).voxelSize();
  if (voxel == 0.0 && frame.surfacePhi) voxel = frame.surfacePhi->voxelSize().x();
  return 0.5 * voxel;
}

// Where a vertex landed on the previous surface.
struct Landing {
  SurfacePoint point;
  Vec3I corners{0u, 0u, 0u};
  int nearest = 0;     // corner nearest to the landing point
  Vec3f normal{0.0f};  // interpolated, unit
};

Landing landingAt(const TexturedSurface& previous, const SurfacePoint& point) {
  Landing landing;
  landing.point = point;
  landing.corners = previous.triangles[point.triangle];
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t u = landing.corners[i];
    landing.normal += previous.normals[u] * point.weight[i];
    const double distance2 = (Vec3d(previous.positions[u]) - point.position).lengthSqr();
    if (distance2 < least) {
      least = distance2;
      landing.nearest = i;
    }
  }
  if (!landing.normal.normalize()) landing.normal = previous.normals[landing.corners[landing.nearest]];
  return landing;
}

// Straight alpha, averaged premultiplied, so that colour where nothing is opaque does not bleed.
Vec4f colorAt(const TexturedSurface& previous, const Landing& landing) {
  Vec4f straight(0.0f), premultiplied(0.0f);
  for (int i = 0; i < 3; ++i) {
    const Vec4f& c = previous.color[landing.corners[i]];
    const float weight = landing.point.weight[i];
    straight += c * weight;
    premultiplied += Vec4f(c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]) * weight;
  }
  const float alpha = premultiplied[3];
  if (!(alpha > 1e-6f)) return straight;
  return {premultiplied[0] / alpha, premultiplied[1] / alpha, premultiplied[2] / alpha, alpha};
}

// The corners' vectors, each turned from its own tangent plane into the landing point's, averaged. Of
// directions that are equal by the field's symmetry, those nearest to the nearest corner's count.
Vec3f orientationAt(const TexturedSurface& previous, const Landing& landing, int symmetry) {
  const auto turned = [&](std::uint32_t corner) {
    const Vec3f &d = previous.orientation[corner], &from = previous.normals[corner], &to = landing.normal;
    return from.dot(to) > -0.9f ? texture::turnedTangent(d, from, to) : d;
  };
  const Vec3f nearest = turned(landing.corners[landing.nearest]);
  Vec3f sum(0.0f);
  for (int i = 0; i < 3; ++i) {
    sum += texture::nearestTurn(turned(landing.corners[i]), landing.normal, nearest, symmetry) *
           landing.point.weight[i];
  }
  // Near a singularity the corners cancel out; there one of them is as good as any.
  return sum.length() > 1e-3f ? sum : nearest;
}

// Equation (4) along a path: D d/Dt = (I - d d^T) A d, A = grad u. With D l/Dt = A l and d = l/|l| it follows
// at once, and l is carried by the gradient of the flow: l_new = (d x_new / d x_old) l_old = B^-1 l_old
// [Kwatra07 sec. VI]. So the whole frame's turn is one product with the matrix that the trace brings along,
// exact for the traced map, and |d| = 1 by normalising. What is tangent stays tangent up to the difference of
// the two meshes, which the projection removes.
Vec3f turnedWithFlow(const Vec3f& d, const Mat3d& map, const Vec3f& normal) {
  const Mat3d inverse = adjugate(map);  // times det B, whose sign is all that matters here
  const double sign = map.det() < 0.0 ? -1.0 : 1.0;
  return texture::tangentUnit(Vec3f(inverse * Vec3d(d) * sign), normal, anyTangent(normal));
}

// q(x_new) = q_old(origin(x_new)), so its gradient is grad q_old B; what points out of the new surface has no
// meaning on it.
TexelGradient deformed(const TexelGradient& gradient, const Mat3d& map, const Vec3f& normal) {
  const auto row = [&](const Vec3f& old) {
    const Vec3f x = rowTimes(old, map);
    return x - normal * normal.dot(x);
  };
  return {row(gradient.s), row(gradient.t)};
}

// Where in the exemplar a vertex that landed near a corner comes from, and how that changes around it: the
// corner's own place plus its gradient times the offset. Never an average of corners, between which there may
// be a jump.
struct Place {
  Vec2f coordinate;
  TexelGradient gradient;
};
Place placeNear(const Vec2f& coordinate, const TexelGradient& gradient, const Vec3f& offset, const Mat3d& map,
                const Vec3f& normal) {
  return {coordinate + Vec2f(gradient.s.dot(offset), gradient.t.dot(offset)),
          deformed(gradient, map, normal)};
}

// How far the value is believed: exp(-(distance to the old surface / scale)^2), times the share of the path
// along which the velocity is known, times a factor that falls from 1 to 0 as the angle between the carried
// normal and the old surface's grows from 60 to 90 degrees.
float trustOf(const Landing& landing, double scale, float known, const Vec3f& carriedNormal) {
  const double off = landing.point.distance / scale;
  const float agreement = std::clamp(2.0f * landing.normal.dot(carriedNormal), 0.0f, 1.0f);
  return float(std::exp(-off * off)) * known * agreement;
}

}  // namespace

std::vector<Vec3f> moved(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  return traceForward(positions, frame);
}

std::vector<Vec3f> velocityAt(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  std::vector<Vec3f> result(positions.size(), Vec3f(0.0f));
  if (frame.substeps.empty()) return result;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      VelocitySampler sampler(frame.substeps.back());
                      for (std::size_t v = range.begin(); v != range.end(); ++v) {
                        result[v] = Vec3f(sampler.velocity(Vec3d(positions[v])).velocity);
                      }
                    });
  return result;
}

std::vector<std::uint8_t> contactAt(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  std::vector<std::uint8_t> result(positions.size(), 0);
  if (!frame.solidPhi) return result;
  const sim::FloatGrid& solid = *frame.solidPhi;
  const auto limit = float(0.5 * solid.voxelSize().x());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const auto accessor = solid.getConstAccessor();
                      for (std::size_t v = range.begin(); v != range.end(); ++v) {
                        const Vec3d index = solid.worldToIndex(Vec3d(positions[v]));
                        result[v] = openvdb::tools::BoxSampler::sample(accessor, index) < limit ? 1 : 0;
                      }
                    });
  return result;
}

texture::Carried carry(const TexturedSurface& previous, const sim::Frame& frame, const SurfaceMesh& next,
                       int symmetry) {
  Carried carried;
  if (previous.empty() || previous.triangles.empty()) return carried;
  const std::size_t count = next.positions.size();
  const double least = halfVoxel(frame);
  const Backtrace trace = traceBack(next.positions, frame);
  const ClosestPoint closest(previous.positions, previous.triangles);

  carried.orientation.resize(count);
  carried.color.resize(count);
  carried.coordinate.resize(count);
  carried.gradient.resize(count);
  carried.fading = {std::vector<Vec2f>(count), std::vector<TexelGradient>(count), std::vector<float>(count),
                    std::vector<float>(count)};
  carried.age.resize(count);
  carried.trust.resize(count);
  carried.previousPosition.resize(count);
  texture::forEachIndex(count, [&](std::uint32_t v) {
    const Mat3d& map = trace.map[v];
    const double scale = std::max(least, next.spacingAt(v));
    const Vec3f& normal = next.normals[v];
    // A normal is a gradient, grad phi_new = grad phi_old B; so the old one is B^-T of the new one, = (adj
    // B)^T up to a factor.
    Vec3f carriedNormal(adjugate(map).transpose() * Vec3d(normal) * (map.det() < 0.0 ? -1.0 : 1.0));
    if (!carriedNormal.normalize(0.0f)) carriedNormal = normal;
    const Landing landing =
        landingAt(previous, closest.nearest(trace.origin[v], carriedNormal, kOtherSide * scale));

    const std::uint32_t corner = landing.corners[landing.nearest];
    const Vec3f offset(landing.point.position - Vec3d(previous.positions[corner]));
    const Place place =
        placeNear(previous.coordinate[corner], previous.gradient[corner], offset, map, normal);
    carried.coordinate[v] = place.coordinate;
    carried.gradient[v] = place.gradient;
    const texture::Fading& fading = previous.fading;
    const Place former = placeNear(fading.coordinate[corner], fading.gradient[corner], offset, map, normal);
    carried.fading.coordinate[v] = former.coordinate;
    carried.fading.gradient[v] = former.gradient;
    carried.fading.weight[v] = fading.weight[corner];
    carried.fading.speed[v] = fading.speed[corner];
    carried.color[v] = colorAt(previous, landing);
    carried.orientation[v] = turnedWithFlow(orientationAt(previous, landing, symmetry), map, normal);
    for (int i = 0; i < 3; ++i) carried.age[v] += previous.age[landing.corners[i]] * landing.point.weight[i];
    carried.trust[v] = trustOf(landing, scale, trace.known[v], carriedNormal);
    carried.previousPosition[v] = Vec3f(landing.point.position);
  });
  return carried;
}

}  // namespace fluidtex::transport
