// Small helpers on single-precision vectors for the inner loops of the path tracer.
#pragma once

#include <openvdb/math/Vec2.h>
#include <openvdb/math/Vec3.h>
#include <openvdb/math/Vec4.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::render {

using Vec2f = openvdb::math::Vec2<float>;
using Vec3f = openvdb::math::Vec3<float>;
using Vec4f = openvdb::math::Vec4<float>;

inline constexpr float kPi = 3.14159265358979f;

inline float lengthSquared(const Vec3f& v) {
  return v.dot(v);
}

// v / |v|; a null vector stays null.
inline Vec3f normalized(const Vec3f& v) {
  const float squared = lengthSquared(v);
  return squared > 0.0f ? v * (1.0f / std::sqrt(squared)) : v;
}

// Brightness of a linear Rec. 709 colour.
inline float luminance(const Vec3f& c) {
  return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

inline float largest(const Vec3f& v) {
  return std::max(v[0], std::max(v[1], v[2]));
}

inline Vec3f mix(const Vec3f& a, const Vec3f& b, float t) {
  return a + (b - a) * t;
}

// 0 below `from`, 1 above `to`, smooth between.
inline float smoothStep(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Right-handed orthonormal axes around a unit z axis [Duff17, Building an orthonormal basis, revisited].
struct Axes {
  Vec3f x, y, z;

  explicit Axes(const Vec3f& n) : z(n) {
    const float sign = std::copysign(1.0f, n[2]);
    const float a = -1.0f / (sign + n[2]);
    const float b = n[0] * n[1] * a;
    x = Vec3f(1.0f + sign * n[0] * n[0] * a, sign * b, -sign * n[0]);
    y = Vec3f(b, sign + n[1] * n[1] * a, -n[1]);
  }

  Vec3f world(const Vec3f& local) const { return x * local[0] + y * local[1] + z * local[2]; }
  Vec3f local(const Vec3f& v) const { return Vec3f(v.dot(x), v.dot(y), v.dot(z)); }
};

}  // namespace fluidtex::render
