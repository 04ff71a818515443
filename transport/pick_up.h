// What a place on a textured surface says: the values that a vertex which landed there takes with it.
#pragma once

#include "texture/surface.h"
#include "transport/closest_point.h"

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec2f;
using openvdb::Vec4f;
using texture::TexelGradient;
using texture::TexturedSurface;

// A place on a surface.
struct Landing {
  SurfacePoint point;
  Vec3I corners{0u, 0u, 0u};
  int nearest = 0;     // corner nearest to the place
  Vec3f normal{0.0f};  // interpolated, unit

  std::uint32_t nearestVertex() const { return corners[nearest]; }
};

Landing landingAt(const TexturedSurface& surface, const SurfacePoint& point);

// Barycentric: for what is smooth over the surface.
template <typename Value>
Value valueAt(const std::vector<Value>& values, const Landing& landing) {
  const Vec3I& corner = landing.corners;
  const Vec3f& weight = landing.point.weight;
  return values[corner[0]] * weight[0] + values[corner[1]] * weight[1] + values[corner[2]] * weight[2];
}
// Straight alpha, averaged premultiplied, so that colour where nothing is opaque does not bleed.
Vec4f colorAt(const TexturedSurface& surface, const Landing& landing);

// An exemplar coordinate and its gradient, texels and texels per metre.
struct Texel {
  Vec2f coordinate{0.0f};
  TexelGradient gradient;
};

// The coordinate at a place is the nearest corner's plus its gradient times the offset; it is never averaged,
// since corners may belong to different pieces of the exemplar. The gradient is turned from the corner's
// tangent plane into the landing point's, deformed by the flow's map B = d old / d new, q(new) =
// q_old(old(new)), and laid into the plane of `normal`.
Texel texelAt(const TexturedSurface& surface, const std::vector<Vec2f>& coordinate,
              const std::vector<TexelGradient>& gradient, const Landing& landing, const Mat3d& map,
              const Vec3f& normal);

}  // namespace fluidtex::transport
