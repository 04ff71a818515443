// Values of a textured surface at a point on it.
#pragma once

#include "texture/surface.h"
#include "transport/closest_point.h"

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec2f;
using openvdb::Vec4f;
using texture::TexelGradient;
using texture::TexturedSurface;

// A point on a surface.
struct Landing {
  SurfacePoint point;
  Vec3I corners{0u, 0u, 0u};
  int nearest = 0;     // corner nearest to the point
  Vec3f normal{0.0f};  // interpolated, unit

  std::uint32_t nearestVertex() const { return corners[nearest]; }
};

Landing landingAt(const TexturedSurface& surface, const SurfacePoint& point);

// Barycentric, for values that are smooth over the surface.
template <typename Value>
Value valueAt(const std::vector<Value>& values, const Landing& landing) {
  const Vec3I& corner = landing.corners;
  const Vec3f& weight = landing.point.weight;
  return values[corner[0]] * weight[0] + values[corner[1]] * weight[1] + values[corner[2]] * weight[2];
}
// Straight alpha, averaged premultiplied, so that the colour of transparent corners does not bleed.
Vec4f colorAt(const TexturedSurface& surface, const Landing& landing);

// An exemplar coordinate and its gradient, texels and texels per metre.
struct Texel {
  Vec2f coordinate{0.0f};
  TexelGradient gradient;
};

// The coordinate is the nearest corner's plus its gradient times the offset; never averaged, since corners
// may belong to different patches. The gradient is parallel transported from the corner's tangent plane to
// the landing point's, deformed by the flow's map B = d old / d new, q(new) = q_old(old(new)), and projected
// to the plane of `normal`.
Texel texelAt(const TexturedSurface& surface, const std::vector<Vec2f>& coordinate,
              const std::vector<TexelGradient>& gradient, const Landing& landing, const Mat3d& map,
              const Vec3f& normal);

// What fades at the nearest corner, at vertex v: coordinate and gradient as texelAt(), weight and speed.
// Nothing where that corner does not fade. Requires: as many entries as vertices.
void pickUpFading(const TexturedSurface& surface, const Landing& landing, const Mat3d& map,
                  const Vec3f& normal, std::uint32_t v, texture::Fading& fading);

}  // namespace fluidtex::transport
