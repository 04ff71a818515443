#include "sim/meshes/read_uv_mesh.h"

#include "sim/meshes/cut_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace fluidtex::sim {
namespace {

using openvdb::Vec2d;
using openvdb::Vec2f;
using openvdb::Vec3f;

// Six times the volume that the triangles enclose, positive where they are turned outward. From a place in
// their midst, so that open meshes give a sign too.
double signedVolume(const std::vector<Vec3f>& positions) {
  Vec3d middle(0.0);
  for (const Vec3f& x : positions) middle += Vec3d(x) / double(positions.size());
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const Vec3d a = Vec3d(positions[i]) - middle, b = Vec3d(positions[i + 1]) - middle,
                c = Vec3d(positions[i + 2]) - middle;
    volume += a.dot(b.cross(c));
  }
  return volume;
}

// The three places moved by whole pictures, to where their middle lies on the picture.
std::array<Vec2f, 3> onPicture(const std::array<Vec2d, 3>& places) {
  const Vec2d middle = (places[0] + places[1] + places[2]) / 3.0;
  const Vec2d whole(std::floor(middle[0]), std::floor(middle[1]));
  return {Vec2f(places[0] - whole), Vec2f(places[1] - whole), Vec2f(places[2] - whole)};
}

}  // namespace

UvMesh readUvMesh(const MeshShape& shape) {
  SoupUv uv;
  const MeshSoup soup = readSoup(shape.file, uv);
  const std::vector<Vec3f> placed = placedPoints(shape.file, soup, shape.place);
  UvMesh mesh;
  for (std::size_t n = 0; n < soup.polygons.size(); ++n) {
    const std::vector<std::size_t>&polygon = soup.polygons[n], &corners = uv.corners[n];
    if (std::find(corners.begin(), corners.end(), SoupUv::kNone) != corners.end()) continue;
    // By number in the polygon, which can meet a vertex twice with two places.
    std::vector<Vec3d> points;
    for (const std::size_t vertex : polygon) points.push_back(soup.points[vertex]);
    std::vector<std::size_t> numbers(polygon.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    for (const std::array<std::size_t, 3>& triangle : cutPolygon(points, numbers)) {
      std::array<Vec2d, 3> places;
      for (std::size_t c = 0; c < 3; ++c) {
        mesh.positions.push_back(placed[polygon[triangle[c]]]);
        places[c] = uv.places[corners[triangle[c]]];
      }
      for (const Vec2f& place : onPicture(places)) mesh.uv.push_back(place);
    }
  }
  if (mesh.positions.empty())
    throw MeshError(shape.file.string() +
                    ": no face has texture coordinates; unwrap it, and export its UVs with it");
  if (signedVolume(mesh.positions) < 0.0)
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
      std::swap(mesh.positions[i + 1], mesh.positions[i + 2]);
      std::swap(mesh.uv[i + 1], mesh.uv[i + 2]);
    }
  return mesh;
}

}  // namespace fluidtex::sim
