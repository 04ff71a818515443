#include "sim/shapes/surface_velocity.h"

#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/shape_triangles.h"
#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;
using openvdb::Vec3f;

TEST_CASE("surface velocity: that of the closest point") {
  const Files files({boxObj(Vec3d(0.0), Vec3d(1.0)), boxObj(Vec3d(0.0), Vec3d(2.0, 1.0, 1.0))});
  const MovingMesh mesh(files.sequence);
  const SurfaceVelocity velocity(mesh.at(0, 0.0), mesh.change(0));
  for (const double reach : {0.05, 0.5, 10.0}) {
    CHECK((velocity.at(Vec3d(1.2, 0.3, 0.7), reach) - Vec3d(1, 0, 0)).length() < 1e-6);
    CHECK((velocity.at(Vec3d(0.25, 0.3, 1.1), reach) - Vec3d(0.25, 0, 0)).length() < 1e-6);
    CHECK((velocity.at(Vec3d(0.7, 0.5, 0.9), reach) - Vec3d(0.7, 0, 0)).length() < 1e-6);
    CHECK(velocity.at(Vec3d(-3.0, 0.5, 0.5), reach).length() < 1e-6);
  }
  // A sphere that expands: whatever the triangle, the velocity points outward and is as large as the radius
  // grows.
  const TriangleMesh ball =
      triangulate(Shape{Sphere{Vec3d(0.5), 0.25}}, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.02);
  std::vector<Vec3f> outward;
  for (const Vec3f& x : ball.positions) outward.push_back((x - Vec3f(0.5f)) * 4.0f);
  const SurfaceVelocity expands(ball, outward);
  for (int n = 0; n < 200; ++n) {
    const Vec3d way = Vec3d(std::sin(1.0 * n), std::cos(2.3 * n), std::sin(3.1 * n)).unit();
    for (const double r : {0.2, 0.25, 0.3}) {
      const Vec3d v = expands.at(Vec3d(0.5) + r * way, std::abs(r - 0.25) + 0.02);
      CHECK((v - way).length() < 0.01);
    }
  }
}
