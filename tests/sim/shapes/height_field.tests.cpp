#include "sim/shapes/height_field.h"

#include "sim/shapes/shape_distance.h"
#include "sim/shapes/shape_triangles.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"
#include "tests/sim/shapes/ramp.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("height field: an even slope is a plane, and goes on beyond the domain", "[sim]") {
  const WrittenFile file("ramp.pgm", ramp());
  // 2 x 1 m, rising from 0.1 m.
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.0, 0.0, 0.1)};
  const Vec3d size(2.0, 1.0, 1.0);
  const ShapeDistance distance(Shape{ground}, 1.0 / 32.0, openvdb::BBoxd(Vec3d(0.0), size));
  const double rise = 512.0 / 65535.0 * 32.0, across = 0.5 * rise;
  const auto height = [&](double x, double y) {
    return 0.1 + rise * (x - 1.0 / 64.0) + across * (y - 1.0 / 64.0);
  };
  const double slope = std::sqrt(1.0 + rise * rise + across * across);
  for (double x = 0.5; x < 1.6; x += 0.23) {
    for (double y = 0.4; y < 0.65; y += 0.06) {
      for (const double above : {-0.06, -0.01, 0.0, 0.02, 0.1}) {
        INFO(x << " " << y << " " << above);
        CHECK(std::abs(distance(Vec3d(x, y, height(x, y) + above)) - above / slope) < 1e-4);
      }
    }
  }
  // Its rim goes on, level; near it that is nearer than the plane.
  CHECK(distance(Vec3d(-0.1, 0.5, height(0.0, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(2.1, 0.5, height(2.0, 0.5) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(0.5, 0.5, -0.2)) < 0.0);
  // However far.
  CHECK(distance(Vec3d(-300.0, 0.5, height(0.0, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(300.0, 90.0, height(2.0, 1.0) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(0.5, 0.5, -300.0)) < 0.0);
}

TEST_CASE("height field: a domain without sides has all of it, and its rim goes on", "[sim]") {
  const WrittenFile file("ramp.pgm", ramp());
  // 2 x 1 m, from x = 0.5; the domain would end at x = 1.
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.5, 0.0, 0.1)};
  openvdb::BBoxd domain(Vec3d(0.0), Vec3d(1.0));
  domain.min()[0] = -kForever;
  domain.max()[0] = kForever;
  const ShapeDistance distance(Shape{ground}, 1.0 / 32.0, domain);
  const double rise = 512.0 / 65535.0 * 32.0;
  const auto height = [&](double x, double y) {
    return 0.1 + rise * (x - 0.5 - 1.0 / 64.0) + 0.5 * rise * (y - 1.0 / 64.0);
  };
  for (const double x : {0.8, 1.2, 1.9}) {
    CHECK(distance(Vec3d(x, 0.5, height(x, 0.5) + 0.05)) > 0.03);
    CHECK(distance(Vec3d(x, 0.5, height(x, 0.5) - 0.05)) < -0.03);
  }
  CHECK(distance(Vec3d(40.0, 0.5, height(2.48, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(40.0, 0.5, height(2.48, 0.5) - 0.05)) < -0.03);
  CHECK(distance(Vec3d(-40.0, 0.5, height(0.52, 0.5) + 0.05)) > 0.03);
  CHECK(distance(Vec3d(-40.0, 0.5, height(0.52, 0.5) - 0.05)) < -0.03);
}

TEST_CASE("height field: is drawn closed, within the domain", "[sim]") {
  const WrittenFile file("ramp.pgm", ramp());
  const HeightField ground{file.path, 1.0 / 32.0, 0.0, 1.0, Vec3d(0.0, 0.0, 0.1)};
  const TriangleMesh mesh =
      triangulate(Shape{ground}, openvdb::BBoxd(Vec3d(0.0), Vec3d(2.0, 1.0, 1.0)), 1.0 / 16.0);
  const double rise = 512.0 / 65535.0 * 32.0;
  // The mean height over the domain's floor.
  CHECK(volumeOf(mesh) ==
        Approx(2.0 * (0.1 + rise * (1.0 - 1.0 / 64.0) + 0.5 * rise * (0.5 - 1.0 / 64.0))).epsilon(1e-3));
  for (const openvdb::Vec3f& x : mesh.positions)
    CHECK(
        (x.x() >= 0.0f && x.x() <= 2.0f && x.y() >= 0.0f && x.y() <= 1.0f && x.z() >= 0.0f && x.z() <= 1.0f));
}

TEST_CASE("height field: mountains above a small domain, and one that has no end", "[sim]") {
  const WrittenFile file("ramp.pgm", ramp());
  // A pixel of 30 m, up to 1000 m, in a domain of a metre: a cliff at most.
  HeightField ground{file.path, 30.0, 0.0, 1000.0};
  const openvdb::BBoxd domain(Vec3d(0.0), Vec3d(1.0));
  const TriangleMesh mesh = groundMesh(ground, domain, 1.0 / 32.0, 1.0, -1.0);
  for (const openvdb::Vec3f& x : mesh.positions) REQUIRE(x.z() <= 2.0f);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  ground.translate = Vec3d(0.0, 0.0, -100.0);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  ground.low = 200.0;
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) < 0.0);
  // Beside the domain there is none.
  ground.translate = Vec3d(5.0, 0.0, 0.0);
  CHECK(ShapeDistance(Shape{ground}, 1.0 / 32.0, domain)(Vec3d(0.5, 0.5, 0.5)) > 0.0);
  CHECK_THROWS_WITH(ShapeDistance(Shape{ground}, 1.0 / 32.0),
                    Catch::Matchers::Contains("1.92e+03 x 961 m") && Catch::Matchers::Contains("pixel"));
}
