#include "sim/shapes/shape_triangles.h"

#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

const openvdb::BBoxd kDomain(Vec3d(0.0), Vec3d(2.0, 1.5, 1.0));
constexpr double kVoxel = 0.05;

}  // namespace

TEST_CASE("shape triangles: boxes are twelve triangles, cut at the domain", "[sim]") {
  const TriangleMesh box = triangulate(Shape{Box{Vec3d(0.25), Vec3d(0.75)}}, kDomain, kVoxel);
  CHECK(box.positions.size() == 8);
  CHECK(box.triangles.size() == 12);
  CHECK(isClosed(box));
  CHECK_THAT(volumeOf(box), WithinAbs(0.125, 1e-7));
  CHECK_THAT(volumeOf(triangulate(Shape{Box{Vec3d(-1.0), Vec3d(0.5)}}, kDomain, kVoxel)),
             WithinAbs(0.125, 1e-7));
  CHECK(triangulate(Shape{Box{Vec3d(3.0), Vec3d(4.0)}}, kDomain, kVoxel).triangles.empty());
}

TEST_CASE("shape triangles: what moves is cut at the domain where it is, not where it began", "[sim]") {
  Solid solid;
  solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(-1.0, 0.0, 0.0), 0.0}};
  const auto volumeAt = [&](double t) { return volumeOf(triangulate(solid, t, kDomain, kVoxel)); };
  SECTION("a box comes in from the right") {
    solid.shape.kind = Box{Vec3d(2.0, 0.25, 0.25), Vec3d(2.5, 0.75, 0.75)};
    CHECK(volumeAt(0.0) == 0.0);
    CHECK_THAT(volumeAt(0.25), WithinAbs(0.0625, 1e-6));
    CHECK_THAT(volumeAt(1.0), WithinAbs(0.125, 1e-6));
  }
  SECTION("a turning one stays a box") {
    solid.shape.kind = Box{Vec3d(0.75, 0.5, 0.25), Vec3d(1.25, 1.0, 0.75)};
    solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(0.0), 45.0}};
    CHECK_THAT(volumeAt(0.5), WithinAbs(0.125, 1e-6));
    CHECK(isClosed(triangulate(solid, 0.5, kDomain, kVoxel)));
  }
  SECTION("a ball comes in from the right") {
    const double ball = 4.0 / 3.0 * std::numbers::pi * 0.027;
    solid.shape.kind = Sphere{Vec3d(2.0, 0.75, 0.5), 0.3};
    CHECK_THAT(volumeAt(0.0), WithinAbs(0.5 * ball, 0.05 * ball));
    CHECK_THAT(volumeAt(1.0), WithinAbs(ball, 0.02 * ball));
  }
}

TEST_CASE("shape triangles: half-spaces are cut at the domain exactly", "[sim]") {
  const double whole = kDomain.volume();
  const auto mesh = [](const Vec3d& point, const Vec3d& normal) {
    return triangulate(Shape{HalfSpace{point, normal}}, kDomain, kVoxel);
  };
  // Through the middle: half of it, however tilted.
  for (const Vec3d& normal :
       {Vec3d(0, 0, 1), Vec3d(1, 2, 3), Vec3d(-1, 0.1, 0.2), Vec3d(0, -1, 1), Vec3d(1, 1, 1)}) {
    const TriangleMesh part = mesh(kDomain.getCenter(), normal);
    CAPTURE(normal.x(), normal.y(), normal.z());
    CHECK(isClosed(part));
    CHECK_THAT(volumeOf(part), WithinAbs(0.5 * whole, 1e-6));
  }
  // A corner: the tetrahedron x + y + z < 0.6. The rest: all but it.
  const TriangleMesh corner = mesh(Vec3d(0.6, 0, 0), Vec3d(1, 1, 1));
  CHECK(corner.triangles.size() == 4);
  CHECK_THAT(volumeOf(corner), WithinAbs(0.036, 1e-7));
  const TriangleMesh rest = mesh(Vec3d(0.6, 0, 0), Vec3d(-1, -1, -1));
  CHECK(isClosed(rest));
  CHECK_THAT(volumeOf(rest), WithinAbs(whole - 0.036, 1e-6));
  // All of the domain, none of it, and a plane that lies in a face.
  CHECK_THAT(volumeOf(mesh(Vec3d(0, 0, 7), Vec3d(0, 0, 1))), WithinAbs(whole, 1e-6));
  CHECK(mesh(Vec3d(0, 0, -7), Vec3d(0, 0, 1)).triangles.empty());
  CHECK(mesh(Vec3d(0, 0, 0), Vec3d(0, 0, 1)).triangles.empty());
  CHECK_THAT(volumeOf(mesh(Vec3d(0, 0, 1), Vec3d(0, 0, 1))), WithinAbs(whole, 1e-6));
}

TEST_CASE("shape triangles: curved and combined shapes are closed, outward and of the right volume",
          "[sim]") {
  const Sphere ball{Vec3d(1.0, 0.75, 0.5), 0.3};
  const double ballVolume = 4.0 / 3.0 * std::numbers::pi * 0.027;
  const TriangleMesh sphere = triangulate(Shape{ball}, kDomain, kVoxel);
  CHECK(isClosed(sphere));
  CHECK_THAT(volumeOf(sphere), WithinAbs(ballVolume, 0.02 * ballVolume));
  for (const auto& x : sphere.positions)
    REQUIRE_THAT((Vec3d(x) - ball.center).length(), WithinAbs(0.3, 1e-6));

  const TriangleMesh cut = triangulate(Shape{Sphere{Vec3d(0.0, 0.75, 0.5), 0.3}}, kDomain, kVoxel);
  CHECK(isClosed(cut));
  CHECK_THAT(volumeOf(cut), WithinAbs(0.5 * ballVolume, 0.05 * ballVolume));

  // However fine the cells are, the sides of a cylinder can be counted.
  const Cylinder rod{Vec3d(1.0, 0.75, 0.25), Vec3d(1.0, 0.75, 0.75), 0.2};
  CHECK_THAT(volumeOf(triangulate(Shape{rod}, kDomain, 1e-11)),
             Catch::Matchers::WithinRel(0.02 * std::numbers::pi, 1e-3));

  const Shape box{Box{Vec3d(0.5, 0.25, 0.0), Vec3d(1.5, 1.25, 0.5)}};
  // The same out of a box elsewhere.
  const Vec3d away(-6.0, 3.0, -2.0);
  const TriangleMesh there = triangulate(Shape{Sphere{Vec3d(0.0, 0.75, 0.5) + away, 0.3}},
                                         openvdb::BBoxd(kDomain.min() + away, kDomain.max() + away), kVoxel);
  CHECK_THAT(volumeOf(there), Catch::Matchers::WithinRel(volumeOf(cut), 1e-4));
  const TriangleMesh bowl = triangulate(Shape{Difference{{box, Shape{ball}}}}, kDomain, 0.025);
  CHECK(isClosed(bowl));
  CHECK_THAT(volumeOf(bowl), WithinAbs(0.5 - 0.5 * ballVolume, 0.01));
  const TriangleMesh knob = triangulate(Shape{Union{{box, Shape{ball}}}}, kDomain, 0.025);
  CHECK(isClosed(knob));
  CHECK_THAT(volumeOf(knob), WithinAbs(0.5 + 0.5 * ballVolume, 0.01));
}

TEST_CASE("shape triangles: a cylinder has its volume", "[sim]") {
  const Cylinder upright{Vec3d(0.5, 0.5, 0.2), Vec3d(0.5, 0.5, 0.8), 0.1};
  const TriangleMesh mesh = triangulate(Shape{upright}, kDomain, 0.005);
  CHECK(isClosed(mesh));
  CHECK(volumeOf(mesh) == Approx(std::numbers::pi * 0.01 * 0.6).epsilon(1e-3));
}
