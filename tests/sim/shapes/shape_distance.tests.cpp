#include "sim/shapes/shape_distance.h"

#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kVoxel = 0.05;

}  // namespace

TEST_CASE("shape distances: closed forms of single shapes", "[sim]") {
  const ShapeDistance box(Shape{Box{Vec3d(0, 0, 0), Vec3d(1, 2, 3)}}, kVoxel);
  CHECK_THAT(box(Vec3d(0.25, 1, 1.5)), WithinAbs(-0.25, 1e-12));
  CHECK_THAT(box(Vec3d(1.5, 1, 1)), WithinAbs(0.5, 1e-12));
  CHECK_THAT(box(Vec3d(4, 6, 3)), WithinAbs(5.0, 1e-12));  // 3-4-5 beyond an edge
  CHECK_THAT(box(Vec3d(-1, -2, -2)), WithinAbs(3.0, 1e-12));

  const ShapeDistance sphere(Shape{Sphere{Vec3d(1, 1, 1), 0.5}}, kVoxel);
  CHECK_THAT(sphere(Vec3d(1, 1, 1)), WithinAbs(-0.5, 1e-12));
  CHECK_THAT(sphere(Vec3d(1, 4, 5)), WithinAbs(4.5, 1e-12));

  const ShapeDistance plane(Shape{HalfSpace{Vec3d(0, 0, 1), Vec3d(0, 3, 4)}},
                            kVoxel);  // the normal need not be unit
  CHECK_THAT(plane(Vec3d(7, 0, 1)), WithinAbs(0.0, 1e-12));
  CHECK_THAT(plane(Vec3d(7, 3, 5)), WithinAbs(5.0, 1e-12));
  CHECK_THAT(plane(Vec3d(7, 0, 0)), WithinAbs(-0.8, 1e-12));
  CHECK_THROWS(ShapeDistance(Shape{HalfSpace{Vec3d(0.0), Vec3d(0.0)}}, kVoxel));
}

TEST_CASE("shape distances: unions and differences keep the sign and never overstate", "[sim]") {
  const Shape left{Box{Vec3d(0.0), Vec3d(1.0)}}, right{Sphere{Vec3d(1.0, 0.5, 0.5), 0.4}};
  const ShapeDistance a(left, kVoxel), b(right, kVoxel);
  const ShapeDistance both(Shape{Union{{left, right}}}, kVoxel),
      less(Shape{Difference{{left, right}}}, kVoxel);
  for (double x = -0.5; x < 2.0; x += 0.11) {
    for (double y = -0.5; y < 1.5; y += 0.13) {
      const Vec3d p(x, y, 0.45);
      REQUIRE((both(p) < 0.0) == (a(p) < 0.0 || b(p) < 0.0));
      REQUIRE((less(p) < 0.0) == (a(p) < 0.0 && b(p) > 0.0));
      REQUIRE(both(p) == std::min(a(p), b(p)));
    }
  }
}

TEST_CASE("shape distances: a mesh as its closed form, to a voxel's curvature", "[sim]") {
  // x + y + z < 0.9 in the corner at (0.2, 0.2, 0.2).
  const WrittenFile file("tetrahedron.obj", vertex(0.2, 0.2, 0.2) + vertex(0.5, 0.2, 0.2) +
                                                vertex(0.2, 0.5, 0.2) + vertex(0.2, 0.2, 0.5) +
                                                "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const double h = 0.02;
  const ShapeDistance mesh(Shape{MeshShape{file.path}}, h);
  CHECK_THAT(mesh(Vec3d(0.25, 0.25, 0.15)), WithinAbs(0.05, 1e-3));
  CHECK_THAT(mesh(Vec3d(0.25, 0.28, 0.22)), WithinAbs(-0.02, 1e-3));
  CHECK_THAT(mesh(Vec3d(0.33, 0.33, 0.33)),
             WithinAbs(0.09 / std::sqrt(3.0), 1e-3));  // x+y+z = 0.9 is the slanted face
  CHECK(mesh(Vec3d(5, 5, 5)) > 0.0);

  const ShapeDistance moved(Shape{MeshShape{file.path, {.scale = 2.0, .translate = Vec3d(1, 0, 0)}}}, h);
  CHECK_THAT(moved(Vec3d(1.5, 0.5, 0.3)), WithinAbs(0.1, 1e-3));
}

TEST_CASE("shape distances: a cylinder, upright and askew", "[sim]") {
  const Cylinder upright{Vec3d(0.5, 0.5, 0.2), Vec3d(0.5, 0.5, 0.8), 0.1};
  const ShapeDistance distance(Shape{upright}, 0.1);
  CHECK(distance(Vec3d(0.5, 0.5, 0.5)) == Approx(-0.1));
  CHECK(distance(Vec3d(0.5, 0.7, 0.5)) == Approx(0.1));
  CHECK(distance(Vec3d(0.5, 0.5, 0.75)) == Approx(-0.05));
  CHECK(distance(Vec3d(0.55, 0.5, 1.0)) == Approx(0.2));
  CHECK(distance(Vec3d(0.9, 0.5, 1.2)) == Approx(0.5));
  // The same, turned: only the place in its own frame counts.
  const Vec3d along = Vec3d(1.0, 2.0, 2.0) / 3.0, side = Vec3d(2.0, 1.0, -2.0) / 3.0, from(0.1, 0.2, 0.3);
  const ShapeDistance askew(Shape{Cylinder{from, from + 0.6 * along, 0.1}}, 0.1);
  CHECK(askew(from + 0.3 * along + 0.25 * side) == Approx(0.15));
  CHECK(askew(from - 0.4 * along + 0.4 * side) == Approx(0.5));
}
