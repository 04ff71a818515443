#include "caches/liquid/surface_mesh.h"

#include "tests/caches/liquid/flows.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

void addBall(const Ball& ball, SurfaceTriangles& surface) {
  std::vector<Vec3d> points;
  std::vector<Vec3I> triangles;
  ballMesh(ball, 3, points, triangles);
  const auto offset = openvdb::Index32(surface.points.size());
  for (const Vec3d& x : points) surface.points.emplace_back(x);
  for (const Vec3I& t : triangles) surface.triangles.push_back(t + Vec3I(offset));
}

}  // namespace

TEST_CASE("surface_mesh: pieces below a volume are left out, however they are turned", "[caches]") {
  SurfaceTriangles surface;
  // 4.19 m3, 0.0335 m3 and 0.000524 m3, far from the origin.
  for (const double radius : {1.0, 0.2, 0.05})
    addBall({Vec3d(500.0 + 10.0 * radius, 300, 100), radius}, surface);
  std::size_t one = surface.triangles.size() / 3;
  for (std::size_t n = one; n < 2 * one; ++n) std::swap(surface.triangles[n][0], surface.triangles[n][1]);
  const auto kept = [&](double least) {
    SurfaceTriangles copy = surface;
    dropPieces(least, copy);
    CHECK(copy.points.size() == surface.points.size());
    return copy.triangles.size() / one;
  };
  CHECK(kept(0.0) == 3);
  CHECK(kept(0.0004) == 3);
  CHECK(kept(0.0006) == 2);
  CHECK(kept(0.03) == 2);
  CHECK(kept(0.04) == 1);
  CHECK(kept(5.0) == 0);
}

TEST_CASE("surface_mesh: mean edge, area and bounds are those of triangles, not of stray points",
          "[caches]") {
  const SurfaceTriangles triangle{{Vec3f(0, 0, 0), Vec3f(3, 0, 0), Vec3f(3, 4, 0), Vec3f(99, 99, 99)},
                                  {Vec3I(0, 1, 2)}};
  CHECK(meanEdge(triangle) == Approx(4.0));
  CHECK(areaOf(triangle) == Approx(6.0));
  CHECK(boundsOf(triangle) == openvdb::BBoxd(Vec3d(0, 0, 0), Vec3d(3, 4, 0)));
  CHECK(meanEdge({}) == 0.0);
  CHECK(areaOf({}) == 0.0);
  CHECK(boundsOf({}).empty());
}

TEST_CASE("surface_mesh: the surface of a grid lies where its transform says", "[caches]") {
  openvdb::initialize();
  const auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(0.5f, Vec3f(1, 2, 3), 0.05f);
  for (const double iso : {0.0, 0.05}) {
    const SurfaceTriangles surface = surfaceOfGrid(*sphere, iso);
    REQUIRE(surface.triangles.size() > 1000);
    for (const Vec3f& x : surface.points)
      CHECK((Vec3d(x) - Vec3d(1, 2, 3)).length() == Approx(0.5 + iso).margin(0.005));
  }
}

TEST_CASE("surface_mesh: placed by a matrix of row vectors", "[caches]") {
  openvdb::Mat4d matrix = openvdb::Mat4d::identity();
  matrix.setMat3(openvdb::Mat3d(0, 2, 0, -2, 0, 0, 0, 0, 2));
  matrix.setTranslation(Vec3d(10, 20, 30));
  std::vector<Vec3f> points{Vec3f(1, 0, 0), Vec3f(0, 1, 1)};
  place(matrix, points);
  CHECK(points[0] == Vec3f(10, 22, 30));
  CHECK(points[1] == Vec3f(8, 20, 32));
}
