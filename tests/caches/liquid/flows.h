// Flows in closed form, and a ball that they carry.
#pragma once

#include "sim/vec3.h"

#include <openvdb/Types.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace fluidtex::caches {

using openvdb::Vec3d;

struct Flow {
  std::function<Vec3d(const Vec3d& x, double t)> velocity;  // m/s
  std::function<Vec3d(const Vec3d& x, double t)> moved;     // where a point of time 0 is at t
};

inline constexpr double kGravity = 9.81;

inline Flow freeFall() {
  return {[](const Vec3d&, double t) { return Vec3d(0, 0, -kGravity * t); },
          [](const Vec3d& x, double t) { return x - Vec3d(0, 0, 0.5 * kGravity * t * t); }};
}

inline Flow translation(const Vec3d& velocity) {
  return {[=](const Vec3d&, double) { return velocity; },
          [=](const Vec3d& x, double t) { return x + t * velocity; }};
}

// About an axis along z, radians a second.
inline Flow rotation(const Vec3d& center, double rate) {
  return {[=](const Vec3d& x, double) { return rate * Vec3d(center[1] - x[1], x[0] - center[0], 0.0); },
          [=](const Vec3d& x, double t) {
            const double c = std::cos(rate * t), s = std::sin(rate * t);
            const Vec3d d = x - center;
            return center + Vec3d(c * d[0] - s * d[1], s * d[0] + c * d[1], d[2]);
          }};
}

struct Ball {
  Vec3d center{0.5, 0.45, 0.6};
  double radius = 0.2;

  double distance(const Vec3d& x) const { return (x - center).length() - radius; }
};

// Points and triangles of a ball that face outward: an octahedron, each of whose edges is halved `halvings`
// times.
inline void ballMesh(const Ball& ball, int halvings, std::vector<Vec3d>& points,
                     std::vector<openvdb::Vec3I>& triangles) {
  const int n = 1 << halvings;
  points.clear();
  triangles.clear();
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const bool mirrored = sign[0] * sign[1] * sign[2] < 0.0;
    const auto at = [&](int i, int j) {
      const Vec3d flat(double(i) / n, double(j) / n, double(n - i - j) / n);
      points.push_back(ball.center + ball.radius * (sign * flat).unit());
      return openvdb::Index32(points.size() - 1);
    };
    const auto add = [&](openvdb::Index32 a, openvdb::Index32 b, openvdb::Index32 c) {
      triangles.push_back(mirrored ? openvdb::Vec3I(a, c, b) : openvdb::Vec3I(a, b, c));
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (j < n - i - 1) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  // One point where several triangles meet.
  std::vector<std::size_t> order(points.size()), first(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) order[p] = p;
  const auto less = [&](std::size_t a, std::size_t b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double d = points[a][axis] - points[b][axis];
      if (std::abs(d) > 1e-9) return d < 0.0;
    }
    return false;
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<Vec3d> kept;
  for (std::size_t p = 0; p < order.size(); ++p) {
    if (p == 0 || less(order[p - 1], order[p])) kept.push_back(points[order[p]]);
    first[order[p]] = kept.size() - 1;
  }
  points = std::move(kept);
  for (openvdb::Vec3I& t : triangles)
    for (int corner = 0; corner < 3; ++corner) t[corner] = openvdb::Index32(first[t[corner]]);
}

// Points of a lattice of this spacing inside a ball.
inline std::vector<Vec3d> latticeIn(const Ball& ball, double spacing) {
  std::vector<Vec3d> points;
  const int n = int(ball.radius / spacing) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k)
        if (const Vec3d d = spacing * Vec3d(i + 0.5, j + 0.5, k + 0.5); d.length() <= ball.radius)
          points.push_back(ball.center + d);
  return points;
}

}  // namespace fluidtex::caches
