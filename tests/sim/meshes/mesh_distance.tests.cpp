// Level sets of meshes: their inside, what is narrower than OpenVDB's own would leave open, and meshes that
// are much larger than the domain.
#include "sim/meshes/mesh_distance.h"

#include "sim/meshes/read_mesh.h"
#include "sim/shapes/shape_triangles.h"
#include "sim/solids/solids.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using openvdb::BBoxd;

namespace {

constexpr double kVoxel = 1.0 / 32.0;
const BBoxd kUnit(Vec3d(0.0), Vec3d(1.0));

ShapeDistance distanceOf(const std::string& obj, double voxelSize = kVoxel, const BBoxd& domain = kUnit) {
  const WrittenFile file("mesh.obj", obj);
  return ShapeDistance(Shape{MeshShape{file.path}}, voxelSize, domain);
}

double boxDistance(const BBoxd& box, const Vec3d& x) {
  return ShapeDistance(Shape{Box{box.min(), box.max()}}, kVoxel)(x);
}

// body(x) at the corners of the unit cube's cells.
template <class Body>
void forCorners(const Body& body) {
  for (int i = 0; i <= 32; ++i)
    for (int j = 0; j <= 32; ++j)
      for (int k = 0; k <= 32; ++k) body(Vec3d(i * kVoxel, j * kVoxel, k * kVoxel));
}

// A block from (0.3, 0.3, -0.1) to (0.7, 0.7, 0.6) with a slit from above, in one surface.
std::string forked(double from, double to) {
  std::string text;
  for (const double y : {0.3, 0.7})
    for (const auto& [x, z] : {std::pair{0.3, -0.1},
                               {0.7, -0.1},
                               {0.7, 0.6},
                               {to, 0.6},
                               {to, 0.2},
                               {from, 0.2},
                               {from, 0.6},
                               {0.3, 0.6}})
      text += vertex(x, y, z);
  text += "f 1 2 3 4 5 6 7 8\nf 16 15 14 13 12 11 10 9\n";
  for (int n = 1; n <= 8; ++n) {
    const int next = n % 8 + 1;
    text += "f " + std::to_string(next) + " " + std::to_string(n) + " " + std::to_string(n + 8) + " " +
            std::to_string(next + 8) + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("mesh distance: a cavity is one", "[sim]") {
  const BBoxd outer(Vec3d(0.15), Vec3d(0.85)), inner(Vec3d(0.3), Vec3d(0.7));
  const ShapeDistance tank = distanceOf(boxes({outer, inner}));
  forCorners([&](const Vec3d& x) {
    const double wanted = std::max(boxDistance(outer, x), -boxDistance(inner, x));
    // Behind an edge of the wall the exact distance is longer than the larger of the two.
    REQUIRE(tank(x) == Approx(wanted).margin(wanted > 0.0 ? 0.1 : 1e-5));
  });
  // One that is much larger than the band.
  const ShapeDistance wide = distanceOf(
      boxes({BBoxd(Vec3d(-1.0), Vec3d(2.0)), BBoxd(Vec3d(-0.9), Vec3d(1.9))}), kVoxel, kEverywhere);
  CHECK(wide(Vec3d(0.5)) > 0.3);
  CHECK(wide(Vec3d(-0.95, 0.5, 0.5)) == Approx(-0.05).margin(0.02));
  CHECK(wide(Vec3d(-2.0, 0.5, 0.5)) > 0.3);
}

TEST_CASE("mesh distance: of parts that cross each other, what lies within is no surface", "[sim]") {
  const BBoxd block(Vec3d(0.2), Vec3d(0.8)), bar(Vec3d(0.1, 0.3, 0.3), Vec3d(0.9, 0.7, 0.7));
  const ShapeDistance both = distanceOf(boxes({block, bar}));
  forCorners([&](const Vec3d& x) {
    const double wanted = std::min(boxDistance(block, x), boxDistance(bar, x));
    // Inside, the nearest surface is as far as that of either or farther; where they cross, to half a cell.
    if (wanted > 0.0 && wanted < 9.0 * kVoxel) REQUIRE(both(x) == Approx(wanted).margin(1e-4));
    if (wanted < 0.0) REQUIRE(both(x) < std::min(wanted + 0.5 * kVoxel, 1e-6));
  });
  // On the bar's lower side within the block.
  CHECK(both(Vec3d(0.5, 0.5, 0.3)) == Approx(-0.1).margin(0.01));
}

TEST_CASE("mesh distance: of parts side by side, what they share is no surface", "[sim]") {
  // Of different sizes, so that their faces are not the same; as good as touching.
  for (const double gap : {0.0, 1e-6}) {
    const BBoxd block(Vec3d(0.2), Vec3d(0.55, 0.8, 0.8)),
        bar(Vec3d(0.55 + gap, 0.3, 0.3), Vec3d(0.9, 0.7, 0.7));
    const ShapeDistance both = distanceOf(boxes({block, bar}));
    for (const double x : {0.5, 0.54, 0.55, 0.56, 0.6}) CHECK(both(Vec3d(x, 0.5, 0.5)) < -0.15);
    CHECK(both(Vec3d(0.7, 0.5, 0.25)) == Approx(0.05).margin(1e-4));
  }
}

TEST_CASE("mesh distance: slits narrower than two cells stay open, as between two meshes", "[sim]") {
  for (const double gap : {0.02, 0.04, 0.05, 0.06}) {
    const BBoxd left(Vec3d(0.3, 0.3, -0.1), Vec3d(0.5, 0.7, 0.6)),
        right(Vec3d(0.5 + gap, 0.3, -0.1), Vec3d(0.75, 0.7, 0.6));
    const ShapeDistance one = distanceOf(boxes({left, right})), a = distanceOf(boxes({left})),
                        b = distanceOf(boxes({right}));
    CAPTURE(gap);
    forCorners([&](const Vec3d& x) {
      REQUIRE(one(x) == std::min(a(x), b(x)));
      // Beside corners, where they are interpolated far away: there to a quarter of a cell.
      const Vec3d beside = x + Vec3d(0.3 * kVoxel);
      const double nearer = std::min(a(beside), b(beside));
      if (std::abs(nearer) < kExactMeshBand * kVoxel) REQUIRE(one(beside) == nearer);
      REQUIRE(one(beside) == Approx(nearer).margin(0.25 * kVoxel).epsilon(0.0));
    });
    // In one surface: at the heights where there is nothing but the slit.
    const ShapeDistance fork = distanceOf(forked(0.5, 0.5 + gap));
    const BBoxd prongs[2] = {{Vec3d(0.3, 0.3, 0.2), Vec3d(0.5, 0.7, 0.6)},
                             {Vec3d(0.5 + gap, 0.3, 0.2), Vec3d(0.7, 0.7, 0.6)}};
    forCorners([&](const Vec3d& x) {
      if (x.z() < 0.4 || x.z() > 0.45) return;
      REQUIRE(fork(x) ==
              Approx(std::min({boxDistance(prongs[0], x), boxDistance(prongs[1], x), 10.0 * kVoxel}))
                  .margin(1e-4));
    });
  }
}

TEST_CASE("mesh distance: of a mesh that is a thousand times the domain only what lies there is made",
          "[sim]") {
  // The domain lies within; beside it; at its upper side.
  const ShapeDistance around = distanceOf(boxes({BBoxd(Vec3d(-500.0), Vec3d(500.0))}));
  const ShapeDistance beside =
      distanceOf(boxes({BBoxd(Vec3d(300.0, 300.0, -100.0), Vec3d(700.0, 700.0, 600.0))}));
  const ShapeDistance ground =
      distanceOf(boxes({BBoxd(Vec3d(-500.0, -500.0, -100.0), Vec3d(500.0, 500.0, 0.4))}));
  forCorners([&](const Vec3d& x) {
    REQUIRE(around(x) < -0.3);
    REQUIRE(beside(x) > 0.3);
    REQUIRE(ground(x) == Approx(std::clamp(x.z() - 0.4, -10.0 * kVoxel, 10.0 * kVoxel)).margin(1e-4));
  });
  CHECK(around.boundsIn(kUnit).min() == kUnit.min());
  CHECK(around.boundsIn(kUnit).max() == kUnit.max());
  CHECK(beside.boundsIn(kUnit).empty());
  // Drawn: the part in the domain.
  const WrittenFile file("ground.obj",
                         boxes({BBoxd(Vec3d(-500.0, -500.0, -100.0), Vec3d(500.0, 500.0, 0.4))}));
  const TriangleMesh drawn = triangulate(Shape{MeshShape{file.path}}, kUnit, kVoxel);
  CHECK(volumeOf(drawn) == Approx(0.4).epsilon(0.02));
}

TEST_CASE("mesh distance: where there is no end, it says what is how large", "[sim]") {
  const WrittenFile file("rock.obj", boxes({BBoxd(Vec3d(0.0), Vec3d(1000.0, 2000.0, 500.0))}));
  try {
    ShapeDistance(Shape{MeshShape{file.path}}, kVoxel);
    FAIL("no fault");
  } catch (const MeshError& error) {
    CHECK_THAT(error.what(),
               Contains("rock.obj: measures 1e+03 x 2e+03 x 500 m") && Contains("scale of 0.001"));
  }
}

TEST_CASE("mesh distance: a mesh that moves in from outside is made for where it gets to", "[sim]") {
  const WrittenFile file("block.obj", boxes({BBoxd(Vec3d(5.0, 0.25, 0.25), Vec3d(5.5, 0.75, 0.75))}));
  Options options;
  options.resolution = 32;
  Solid solid;
  solid.shape.kind = MeshShape{file.path};
  solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(-4.75, 0.0, 0.0), 0.0}};
  options.solids = {solid};
  const Solids solids(options);
  CHECK(solids.distance(Vec3d(0.5), 0.0) > 0.3);
  CHECK(solids.distance(Vec3d(0.5), 1.0) == Approx(-0.25).margin(1e-3));
  // The same by a half turn about (2.75, 0.5).
  options.solids[0].keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(0.0), 180.0}};
  options.solids[0].pivot = Vec3d(2.875, 0.5, 0.0);
  const Solids turned(options);
  CHECK(turned.distance(Vec3d(0.5), 1.0) == Approx(-0.25).margin(1e-3));
}
