#include "caches/liquid/surface_mesh.h"

#include "caches/liquid/connected.h"

#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

}  // namespace

SurfaceTriangles surfaceOfGrid(const openvdb::FloatGrid& grid, double iso) {
  std::vector<openvdb::Vec4I> quads;
  SurfaceTriangles surface;
  openvdb::tools::volumeToMesh(grid, surface.points, surface.triangles, quads, iso);
  for (const openvdb::Vec4I& quad : quads) {
    surface.triangles.emplace_back(quad[0], quad[1], quad[2]);
    surface.triangles.emplace_back(quad[0], quad[2], quad[3]);
  }
  return surface;
}

void place(const openvdb::Mat4d& worldFromFile, std::vector<Vec3f>& points) {
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t n) { points[n] = Vec3f(worldFromFile.transform(Vec3d(points[n]))); });
}

void dropPieces(double leastVolume, SurfaceTriangles& surface) {
  if (leastVolume <= 0.0 || surface.triangles.empty()) return;
  Connected points(surface.points.size());
  for (const Vec3I& t : surface.triangles) {
    points.join(t[0], t[1]);
    points.join(t[1], t[2]);
  }
  // Volumes against a point of the piece itself, so that those far from the origin lose no digits.
  std::vector<double> volume(surface.points.size(), 0.0);
  for (const Vec3I& t : surface.triangles) {
    const std::uint32_t root = points.lowest(t[0]);
    const Vec3d from(surface.points[root]);
    const auto at = [&](int corner) { return Vec3d(surface.points[t[corner]]) - from; };
    volume[root] += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  std::erase_if(surface.triangles,
                [&](const Vec3I& t) { return std::abs(volume[points.lowest(t[0])]) < leastVolume; });
}

double meanEdge(const SurfaceTriangles& surface) {
  double sum = 0.0;
  for (const Vec3I& t : surface.triangles)
    for (int corner = 0; corner < 3; ++corner)
      sum += (surface.points[t[corner]] - surface.points[t[(corner + 1) % 3]]).length();
  return surface.triangles.empty() ? 0.0 : sum / (3.0 * double(surface.triangles.size()));
}

double areaOf(const SurfaceTriangles& surface) {
  double sum = 0.0;
  for (const Vec3I& t : surface.triangles) {
    const Vec3d from(surface.points[t[0]]);
    sum += 0.5 * (Vec3d(surface.points[t[1]]) - from).cross(Vec3d(surface.points[t[2]]) - from).length();
  }
  return sum;
}

openvdb::BBoxd boundsOf(const SurfaceTriangles& surface) {
  openvdb::BBoxd bounds;
  for (const Vec3I& t : surface.triangles)
    for (int corner = 0; corner < 3; ++corner) bounds.expand(Vec3d(surface.points[t[corner]]));
  return bounds;
}

}  // namespace fluidtex::caches
