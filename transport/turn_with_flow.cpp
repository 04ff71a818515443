#include "transport/turn_with_flow.h"

#include "texture/orientation/tangent.h"

#include <cmath>

namespace fluidtex::transport {

using openvdb::Vec3d;

namespace {

// adj(B) = det(B) B^-1; defined for singular B too.
Mat3d adjugate(const Mat3d& b) {
  const Vec3d r0 = b.row(0), r1 = b.row(1), r2 = b.row(2);
  Mat3d result;
  result.setColumns(r1.cross(r2), r2.cross(r0), r0.cross(r1));
  return result;
}

}  // namespace

Vec3f anyTangent(const Vec3f& n) {
  const Vec3f world = std::abs(n.x()) < 0.9f ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0);
  return (world - n * n.dot(world)).unit();
}

Vec3f turnedWithFlow(const Vec3f& d, const Mat3d& map, const Vec3f& normal) {
  const Mat3d inverse = adjugate(map);  // times det B, whose sign is all that matters here
  const double sign = map.det() < 0.0 ? -1.0 : 1.0;
  return texture::tangentUnit(Vec3f(inverse * Vec3d(d) * sign), normal, anyTangent(normal));
}

Vec3f carriedNormal(const Vec3f& normal, const Mat3d& map) {
  Vec3f old(adjugate(map).transpose() * Vec3d(normal) * (map.det() < 0.0 ? -1.0 : 1.0));
  return old.normalize(0.0f) ? old : normal;
}

}  // namespace fluidtex::transport
