// Surfaces of triangles for tests, and a level set's errors, by all triangles for each cell.
#pragma once

#include "caches/liquid/level_set.h"
#include "numerics/random.h"
#include "tests/caches/liquid/flows.h"

#include <openvdb/math/Proximity.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {

inline SurfaceTriangles surfaceOfBall(const Ball& ball, int halvings) {
  std::vector<Vec3d> points;
  SurfaceTriangles surface;
  ballMesh(ball, halvings, points, surface.triangles);
  surface.points.assign(points.begin(), points.end());
  return surface;
}

inline SurfaceTriangles surfaceOfBox(const Vec3d& low, const Vec3d& high) {
  SurfaceTriangles surface;
  for (int corner = 0; corner < 8; ++corner)
    surface.points.emplace_back(corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                corner & 4 ? high[2] : low[2]);
  for (const openvdb::Vec4I& side :
       {openvdb::Vec4I(0, 4, 6, 2), openvdb::Vec4I(1, 3, 7, 5), openvdb::Vec4I(0, 1, 5, 4),
        openvdb::Vec4I(2, 6, 7, 3), openvdb::Vec4I(0, 2, 3, 1), openvdb::Vec4I(4, 5, 7, 6)}) {
    surface.triangles.emplace_back(side[0], side[1], side[2]);
    surface.triangles.emplace_back(side[0], side[2], side[3]);
  }
  return surface;
}

inline SurfaceTriangles joined(SurfaceTriangles first, const SurfaceTriangles& second) {
  const auto offset = openvdb::Index32(first.points.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (const openvdb::Vec3I& t : second.triangles) first.triangles.push_back(t + openvdb::Vec3I(offset));
  return first;
}

// Each triangle with points of its own.
inline SurfaceTriangles asSoup(const SurfaceTriangles& surface) {
  SurfaceTriangles soup;
  for (const openvdb::Vec3I& t : surface.triangles) {
    const auto n = openvdb::Index32(soup.points.size());
    for (int corner = 0; corner < 3; ++corner) soup.points.push_back(surface.points[t[corner]]);
    soup.triangles.emplace_back(n, n + 1, n + 2);
  }
  return soup;
}

// Triangles in a cube of side 1, with corners up to `size` from each other along each axis.
inline SurfaceTriangles randomTriangles(int count, double size) {
  SurfaceTriangles surface;
  const auto number = [](std::uint64_t n) { return float(randomUnit(7, n)); };
  for (int n = 0; n < count; ++n) {
    const auto at = std::uint64_t(12 * n);
    const openvdb::Vec3f middle(number(at), number(at + 1), number(at + 2));
    for (std::uint64_t corner = 1; corner <= 3; ++corner)
      surface.points.push_back(middle + float(size) * openvdb::Vec3f(number(at + 3 * corner),
                                                                     number(at + 3 * corner + 1),
                                                                     number(at + 3 * corner + 2)));
    surface.triangles.emplace_back(3 * n, 3 * n + 1, 3 * n + 2);
  }
  return surface;
}

inline double distanceToAll(const SurfaceTriangles& surface, const Vec3d& x) {
  double square = 1e300;
  for (const openvdb::Vec3I& t : surface.triangles) {
    Vec3d weight;
    const Vec3d a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
    const Vec3d at = openvdb::math::closestPointOnTriangleToPoint(a, b, c, x, weight);
    if (std::isfinite(at.lengthSqr())) square = std::min(square, (at - x).lengthSqr());
  }
  return std::sqrt(square);
}

// Cells.
struct LevelSetErrors {
  double nearby = 0.0;   // largest of the cells nearer than two cells
  double farther = 0.0;  // and of the others
  double mean = 0.0;     // of all active ones
  double tooNear = 0.0;  // how much nearer than the surface any says that it is
  int missing = 0;       // inactive ones nearer than the band, beside active ones
};

inline LevelSetErrors errorsOf(const LevelSet& levelSet, const SurfaceTriangles& surface, double h) {
  LevelSetErrors errors;
  const auto accessor = levelSet.phi->getConstAccessor();
  const double thickness = levelSet.isSheet ? 0.75 : 0.0;
  double sum = 0.0;
  for (auto value = levelSet.phi->cbeginValueOn(); value; ++value) {
    const double distance = distanceToAll(surface, levelSet.phi->indexToWorld(value.getCoord())) / h;
    const double error = std::abs(double(*value)) / h - std::abs(distance - thickness);
    double& largest = distance < 2.0 ? errors.nearby : errors.farther;
    largest = std::max(largest, std::abs(error));
    errors.tooNear = std::max(errors.tooNear, -error);
    sum += std::abs(error);
    for (int direction = 0; direction < 6; ++direction) {
      openvdb::Coord next = value.getCoord();
      next[direction >> 1] += direction & 1 ? 1 : -1;
      if (accessor.isValueOn(next)) continue;
      const double there = distanceToAll(surface, levelSet.phi->indexToWorld(next)) / h;
      errors.missing += there - thickness < kBand - 0.3;
    }
  }
  errors.mean = sum / double(std::max<openvdb::Index64>(1, levelSet.phi->activeVoxelCount()));
  return errors;
}

}  // namespace fluidtex::caches
