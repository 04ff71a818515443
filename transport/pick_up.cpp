#include "transport/pick_up.h"

#include "texture/orientation/tangent.h"

#include <limits>

namespace fluidtex::transport {

Landing landingAt(const TexturedSurface& surface, const SurfacePoint& point) {
  Landing landing;
  landing.point = point;
  landing.corners = surface.triangles[point.triangle];
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t u = landing.corners[i];
    landing.normal += surface.normals[u] * point.weight[i];
    const double distance2 = (Vec3d(surface.positions[u]) - point.position).lengthSqr();
    if (distance2 < least) {
      least = distance2;
      landing.nearest = i;
    }
  }
  if (!landing.normal.normalize()) landing.normal = surface.normals[landing.nearestVertex()];
  return landing;
}

Vec4f colorAt(const TexturedSurface& surface, const Landing& landing) {
  Vec4f straight(0.0f), premultiplied(0.0f);
  for (int i = 0; i < 3; ++i) {
    const Vec4f& c = surface.color[landing.corners[i]];
    const float weight = landing.point.weight[i];
    straight += c * weight;
    premultiplied += Vec4f(c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]) * weight;
  }
  const float alpha = premultiplied[3];
  if (!(alpha > 1e-6f)) return straight;
  return {premultiplied[0] / alpha, premultiplied[1] / alpha, premultiplied[2] / alpha, alpha};
}

Texel texelAt(const TexturedSurface& surface, const std::vector<Vec2f>& coordinate,
              const std::vector<TexelGradient>& gradient, const Landing& landing, const Mat3d& map,
              const Vec3f& normal) {
  const std::uint32_t corner = landing.nearestVertex();
  const Vec3f offset(landing.point.position - Vec3d(surface.positions[corner]));
  const TexelGradient& old = gradient[corner];
  const Vec3f &from = surface.normals[corner], &to = landing.normal;
  const Mat3d transposed = map.transpose();  // a gradient is a row: (g B)^T = B^T g^T
  const auto carried = [&](const Vec3f& row) {
    const Vec3f turned = from.dot(to) > -0.9f ? texture::turnedTangent(row, from, to) : row;
    const Vec3f x(transposed * Vec3d(turned));
    return x - normal * normal.dot(x);
  };
  return {coordinate[corner] + Vec2f(old.s.dot(offset), old.t.dot(offset)), {carried(old.s), carried(old.t)}};
}

void pickUpFading(const TexturedSurface& surface, const Landing& landing, const Mat3d& map,
                  const Vec3f& normal, std::uint32_t v, texture::Fading& fading) {
  const texture::Fading& from = surface.fading;
  const std::uint32_t corner = landing.nearestVertex();
  if (from.weight.empty() || from.weight[corner] <= 0.0f) return;
  const Texel former = texelAt(surface, from.coordinate, from.gradient, landing, map, normal);
  fading.coordinate[v] = former.coordinate;
  fading.gradient[v] = former.gradient;
  fading.weight[v] = from.weight[corner];
  fading.speed[v] = from.speed[corner];
}

}  // namespace fluidtex::transport
