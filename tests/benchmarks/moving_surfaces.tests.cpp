#include "tools/benchmarks/moving_surfaces.h"

#include "tools/benchmarks/deformed_shapes.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex;
using namespace fluidtex::benchmarks;
using Catch::Contains;
using openvdb::FloatGrid;
using openvdb::Vec3d;
using texture::Vec3f;

namespace {

struct Quads {
  std::vector<Vec3f> points;
  double area = 0.0;  // m2
};

Quads quadsOf(const FloatGrid& phi) {
  Quads quads;
  std::vector<openvdb::Vec4I> corners;
  openvdb::tools::volumeToMesh(phi, quads.points, corners);
  for (const openvdb::Vec4I& q : corners) {
    const auto p = [&](int k) { return Vec3d(quads.points[q[k]]); };
    quads.area +=
        0.5 * ((p(1) - p(0)).cross(p(2) - p(0)).length() + (p(2) - p(0)).cross(p(3) - p(0)).length());
  }
  return quads;
}

// Mean distance, in voxels, of the points from the surface after the motion; `before`: without moving them.
struct Miss {
  double before = 0.0, now = 0.0;
};

Miss missOf(const MovingSurface& surface, const std::vector<Vec3f>& points) {
  using openvdb::tools::BoxSampler;
  REQUIRE(points.size() > 100);
  const std::vector<Vec3f> moved = surface.moved(points);
  REQUIRE(moved.size() == points.size());
  const auto mean = [&](const std::vector<Vec3f>& at) {
    double sum = 0.0;
    for (const Vec3f& p : at)
      sum += std::abs(double(BoxSampler::sample(surface.now->tree(), surface.now->worldToIndex(Vec3d(p)))));
    return sum / double(at.size()) / surface.spacing;
  };
  return {mean(points), mean(moved)};
}

float valueAt(const FloatGrid& phi, const Vec3d& x) {
  return openvdb::tools::BoxSampler::sample(phi.tree(), phi.worldToIndex(x));
}

}  // namespace

TEST_CASE("moving surfaces: each has about the points asked for, one a square of its voxels",
          "[benchmarks]") {
  for (const char* name : {"sphere", "torus", "drops_apart", "drops_merged", "river"}) {
    CAPTURE(name);
    const MovingSurface surface = movingSurface(name, 2000);
    CHECK(surface.spacing == Approx(surface.now->voxelSize()[0]));
    CHECK(surface.before->voxelSize()[0] == surface.now->voxelSize()[0]);
    CHECK(quadsOf(*surface.now).area / (surface.spacing * surface.spacing) == Approx(2000.0).epsilon(0.1));
  }
}

TEST_CASE("moving surfaces: the motion leads from the surface before to that of now", "[benchmarks]") {
  for (const char* name : {"sphere", "torus", "drops_apart", "drops_merged", "river"}) {
    CAPTURE(name);
    const MovingSurface surface = movingSurface(name, 2000);
    std::vector<Vec3f> points = quadsOf(*surface.before).points;
    // Only the water's surface flows along with the river; its bed and the box that cuts it stay.
    if (std::string(name) == "river")
      std::erase_if(points, [](const Vec3f& p) {
        return p.z() < 0.1f || p.x() < 0.1f || p.x() > 0.9f || p.y() < 0.1f || p.y() > 0.9f;
      });
    const Miss miss = missOf(surface, points);
    CHECK(miss.now < 0.1);
    CHECK(miss.before > 2.0 * miss.now);
  }
}

TEST_CASE("moving surfaces: the sphere is the deformation's, at its beginning", "[benchmarks]") {
  const MovingSurface surface = movingSurface("sphere", 2000);
  CHECK(surface.spacing == Approx(std::sqrt(4.0 * std::numbers::pi * 0.15 * 0.15 / 2000.0)));
  for (const Vec3f& p : quadsOf(*surface.before).points)
    REQUIRE((Vec3d(p) - Vec3d(0.35)).length() == Approx(0.15).margin(0.1 * surface.spacing));
  const Vec3f start(0.3f, 0.4f, 0.5f);
  CHECK(surface.moved({start})[0].eq(Vec3f(carriedByDeformation(Vec3d(start), 0.0, 1.0 / 24.0)), 1e-6f));
}

TEST_CASE("moving surfaces: the stretched sphere is where the deformation has carried it", "[benchmarks]") {
  const MovingSurface surface = movingSurface("stretched", 200);
  CHECK(surface.spacing == Approx(std::sqrt(kStretchedArea / 200.0)));
  const Vec3d start(0.4, 0.3, 0.45);
  const Vec3f before(carriedByDeformation(start, 0.0, 1.5 - 1.0 / 24.0)),
      now(carriedByDeformation(start, 0.0, 1.5));
  CHECK(surface.moved({before})[0].eq(now, 1e-5f));
}

TEST_CASE("moving surfaces: between two drops there is air until they merge", "[benchmarks]") {
  const MovingSurface apart = movingSurface("drops_apart", 2000),
                      merged = movingSurface("drops_merged", 2000);
  CHECK(valueAt(*apart.before, Vec3d(0.0)) > 0.0f);
  CHECK(valueAt(*apart.now, Vec3d(0.0)) > 0.0f);
  CHECK(valueAt(*merged.before, Vec3d(0.0)) > 0.0f);
  CHECK(valueAt(*merged.now, Vec3d(0.0)) < 0.0f);
  for (const double side : {-1.0, 1.0}) CHECK(valueAt(*apart.now, Vec3d(0.15 * side, 0.0, 0.0)) < 0.0f);
}

TEST_CASE("moving surfaces: the thirtieth frame of a dam break", "[benchmarks]") {
  const MovingSurface surface = movingSurface("dam_break", 100);
  CHECK(surface.spacing == Approx(1.0 / 16.0));  // no fewer cells than that
  const Miss miss = missOf(surface, quadsOf(*surface.before).points);
  CHECK(miss.now < 0.2);
  CHECK(miss.before > 1.5 * miss.now);
}

TEST_CASE("moving surfaces: a name that there is not is told", "[benchmarks]") {
  CHECK_THROWS_AS(movingSurface("cube", 1000), std::invalid_argument);
  CHECK_THROWS_WITH(movingSurface("cube", 1000), Contains("cube"));
}
