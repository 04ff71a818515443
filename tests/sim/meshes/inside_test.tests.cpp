#include "sim/meshes/inside_test.h"

#include "sim/shapes/shape_triangles.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/somewhere.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using openvdb::BBoxd;

namespace {

TriangleMesh ball() {
  return triangulate(Shape{Sphere{Vec3d(0.5), 0.31}}, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.05);
}

}  // namespace

TEST_CASE("inside test: lines along edges and through vertices are counted right", "[sim]") {
  const WrittenFile file("boxes.obj", boxes({BBoxd(Vec3d(0.0), Vec3d(1.0)), BBoxd(Vec3d(0.5), Vec3d(1.5))}));
  const TriangleMesh mesh = readMesh(MeshShape{file.path});
  const InsideTest inside(mesh);
  for (int i = -2; i <= 14; ++i)
    for (int j = -2; j <= 14; ++j)
      for (int k = -2; k <= 14; ++k) {
        const Vec3d x(0.125 * i, 0.125 * j, 0.125 * k + 0.01);
        const auto within = [&](double low, double high) {
          // Of places on a side, those on the low ones are outside: the line is moved by a vanishing step.
          int all = 1;
          for (int a = 0; a < 2; ++a) all *= x[a] >= low && x[a] < high;
          return all * (x[2] > low && x[2] < high);
        };
        REQUIRE(inside.winding(x) == within(0.0, 1.0) + within(0.5, 1.5));
      }
}

TEST_CASE("inside test: lines along all axes tell the same") {
  const InsideTest inside(ball());
  int within = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vec3d x = somewhere(n);
    const double far = (x - Vec3d(0.5)).length();
    if (far > 0.305 && far < 0.31) continue;  // between the ball and its triangles
    for (int axis = 0; axis < 3; ++axis) REQUIRE(inside.winding(x, axis) == (far < 0.31 ? 1 : 0));
    within += far < 0.31;
  }
  CHECK(within > 200);
}

TEST_CASE("inside test: crossings of a vertical line tell the winding at any height", "[sim]") {
  const InsideTest inside(meshOf("boxes.obj", boxes({BBoxd(Vec3d(0.0), Vec3d(1.0)),
                                                     BBoxd(Vec3d(0.2, 0.2, 2.0), Vec3d(0.8, 0.8, 3.0))})));
  InsideTest::Crossings found;
  inside.crossings(0.5, 0.4, found);
  REQUIRE(found.size() == 4);
  int steps = 0;
  for (const InsideTest::Crossing& c : found) steps += c.step;
  CHECK(steps == 0);
  for (const auto& [z, winding] : {std::pair{-0.5, 0}, {0.5, 1}, {1.5, 0}, {2.5, 1}, {3.5, 0}})
    CHECK(InsideTest::winding(found, z) == winding);
}
