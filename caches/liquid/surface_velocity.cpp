#include "caches/liquid/surface_velocity.h"

#include "caches/liquid/level_set.h"
#include "caches/liquid/velocity_grids.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

// How far off the surface velocities are linear, cells.
constexpr double kLinearReach = 2.0;

Vec3d velocityOf(const std::vector<float>& velocity, std::uint32_t point) {
  const float* v = velocity.data() + 3 * std::size_t(point);
  return {double(v[0]), double(v[1]), double(v[2])};
}

// S with du = S d for d along the normal: -(grad_s u)^T. False for a triangle without an area.
bool slopeOf(const SurfaceTriangles& surface, const std::vector<float>& velocity, const Vec3I& triangle,
             Mat3d& slope, double& area) {
  const Vec3d x[3] = {Vec3d(surface.points[triangle[0]]), Vec3d(surface.points[triangle[1]]),
                      Vec3d(surface.points[triangle[2]])};
  const Vec3d normal = (x[1] - x[0]).cross(x[2] - x[0]);
  const double square = normal.lengthSqr();
  if (!(square > 0.0)) return false;
  area = 0.5 * std::sqrt(square);
  slope = Mat3d::zero();
  for (int corner = 0; corner < 3; ++corner) {
    // Gradient of the corner's weight.
    const Vec3d gradient = normal.cross(x[(corner + 2) % 3] - x[(corner + 1) % 3]) / square;
    const Vec3d u = velocityOf(velocity, triangle[corner]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) slope[i][j] -= gradient[i] * u[j];
  }
  return std::isfinite(square);
}

// Means over the triangles around each point, by their area. ofTriangle(n, area, value) is false for those
// that do not count.
template <class OfTriangle>
std::vector<Mat3d> atPoints(const SurfaceTriangles& surface, const OfTriangle& ofTriangle) {
  std::vector<Mat3d> means(surface.points.size(), Mat3d::zero());
  std::vector<double> areas(surface.points.size(), 0.0);
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    Mat3d value;
    double area = 0.0;
    if (!ofTriangle(n, value, area)) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t point = surface.triangles[n][corner];
      means[point] += value * area;
      areas[point] += area;
    }
  }
  for (std::size_t p = 0; p < means.size(); ++p)
    if (areas[p] > 0.0) means[p] = means[p] * (1.0 / areas[p]);
  return means;
}

std::vector<Mat3d> slopesOf(const SurfaceTriangles& surface, const std::vector<float>& velocity) {
  std::vector<double> areas(surface.triangles.size(), 0.0);
  const std::vector<Mat3d> rough = atPoints(surface, [&](std::size_t n, Mat3d& value, double& area) {
    if (!slopeOf(surface, velocity, surface.triangles[n], value, area)) return false;
    areas[n] = area;
    return true;
  });
  return atPoints(surface, [&](std::size_t n, Mat3d& value, double& area) {
    const Vec3I& t = surface.triangles[n];
    value = (rough[t[0]] + rough[t[1]] + rough[t[2]]) * (1.0 / 3.0);
    area = areas[n];
    return area > 0.0;
  });
}

// Largest length of vectors but for the fastest hundredth.
double mostSpeed(const std::vector<float>& vectors) {
  std::vector<float> squares;
  for (std::size_t n = 0; n + 2 < vectors.size(); n += 3)
    squares.push_back(vectors[n] * vectors[n] + vectors[n + 1] * vectors[n + 1] +
                      vectors[n + 2] * vectors[n + 2]);
  if (squares.empty()) return 0.0;
  const auto at = squares.begin() + std::ptrdiff_t(0.99 * double(squares.size() - 1));
  std::nth_element(squares.begin(), at, squares.end());
  return std::sqrt(double(*at));
}

}  // namespace

int reachInCells(const std::vector<float>& velocity, double seconds, double h) {
  return int(std::clamp(std::ceil(mostSpeed(velocity) * seconds / h) + 3.0, double(kLeastReach),
                        double(kMostReach)));
}

sim::FaceGrids velocityOffSurface(ClosestTriangles& closest, const std::vector<float>& velocity, int band) {
  const std::vector<Mat3d> slopes = slopesOf(closest.surface(), velocity);
  const double h = closest.cellSize();
  const auto valuesAt = [&](const Vec3I& corners, const TrianglePoint& point, double* values) {
    Vec3d off = -h * point.offset;  // from the surface to the cell
    off *= std::min(1.0, kLinearReach * h / std::max(off.length(), 1e-30));
    Vec3d u(0.0);
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t p = corners[corner];
      u += point.weight[corner] * (velocityOf(velocity, p) + slopes[p] * off);
    }
    for (int axis = 0; axis < 3; ++axis) values[axis] = u[axis];
  };
  return velocityGrids(continuedOff(closest, ValuesAt(valuesAt), 3, band));
}

}  // namespace fluidtex::caches
