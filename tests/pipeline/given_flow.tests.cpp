#include "pipeline/given_flow.h"

#include "pipeline/texture_frame.h"
#include "tests/texture/exemplar/test_images.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace fluidtex;
using Catch::Matchers::Contains;
using openvdb::Vec3d;
using openvdb::Vec3f;

namespace {

constexpr double kRadius = 0.3, kVoxel = 0.025, kSeconds = 0.05;
const Vec3d kSpin(0.0, 0.0, 2.0);  // rad/s
const Vec3d kMove(0.6, 0.0, 0.0);  // m/s

Vec3d centreAt(double t) {
  return Vec3d(1.0, 2.0, -3.0) + kMove * t;
}

Vec3f velocityAt(const Vec3d& x, double t) {
  return Vec3f(kMove + kSpin.cross(x - centreAt(t)));
}

openvdb::FloatGrid::Ptr ball(double t) {
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(float(kRadius), Vec3f(centreAt(t)),
                                                                  float(kVoxel), 5.0f);
}

// A ball that flies and spins.
caches::LiquidFrame ofGrids(double t) {
  const openvdb::FloatGrid::Ptr phi = ball(t);
  const auto velocity = openvdb::Vec3SGrid::create();
  velocity->setTransform(phi->transformPtr());
  velocity->topologyUnion(*phi);
  for (auto voxel = velocity->beginValueOn(); voxel; ++voxel)
    voxel.setValue(velocityAt(phi->indexToWorld(voxel.getCoord()), t));
  return pipeline::liquidOf(*phi, velocity);
}

caches::LiquidFrame ofMesh(double t) {
  const caches::SurfaceTriangles mesh = caches::surfaceOfGrid(*ball(t), 0.0);
  std::vector<Vec3f> velocity;
  for (const Vec3f& x : mesh.points) velocity.push_back(velocityAt(Vec3d(x), t));
  return pipeline::liquidOf(mesh, velocity, kVoxel, kSeconds);
}

pipeline::Texturing texturing() {
  scenes::Scene scene;
  scene.texture.points = 3000;
  scene.texture.synthesis.windows = {9, 5};
  scene.sim.frameRate = 1.0 / kSeconds;
  return pipeline::makeTexturing(
      scene, texture::makeExemplar(testing::blobImage(64, 64, 4, 12.0, 1), true, scene.texture.synthesis,
                                   scene.texture.surface.levels));
}

}  // namespace

TEST_CASE("given_flow: texture goes with a ball that flies and spins, out of grids and out of a mesh",
          "[pipeline]") {
  for (const auto& liquidAt : {ofGrids, ofMesh}) {
    pipeline::Texturing made = texturing();
    pipeline::GivenFlow flow;
    texture::TexturedSurface last;
    for (int n = 0; n < 3; ++n) {
      const double t = n * kSeconds;
      const sim::Frame motion = flow.next(liquidAt(t), kSeconds);
      CHECK(motion.index == n + 1);
      CHECK(motion.time == Approx(t));
      const pipeline::TexturedFrame frame = pipeline::textureFrame(made, last, motion);
      const texture::TexturedSurface& surface = frame.surface;
      REQUIRE(surface.positions.size() > 2500);
      for (const Vec3f& x : surface.positions)
        REQUIRE((Vec3d(x) - centreAt(t)).length() == Approx(kRadius).margin(0.1 * kVoxel));
      if (n > 0) {
        REQUIRE(motion.stats.explained);
        CHECK(*motion.stats.explained > 0.97);
        CHECK(frame.synthesis.renewed < 0.05);
        // Each point was where the solid's motion has brought it from.
        const double c = std::cos(kSpin[2] * kSeconds), s = std::sin(kSpin[2] * kSeconds);
        for (std::size_t v = 0; v < surface.positions.size(); v += 31) {
          const Vec3d now = Vec3d(surface.positions[v]) - centreAt(t);
          const Vec3d before =
              centreAt(t - kSeconds) + Vec3d(c * now[0] + s * now[1], c * now[1] - s * now[0], now[2]);
          CHECK((Vec3d(surface.previousPosition[v]) - before).length() < 0.1 * surface.spacing);
        }
      }
      last = surface;
    }
  }
}

TEST_CASE("given_flow: a liquid without velocities rests, with its points and texture", "[pipeline]") {
  pipeline::Texturing made = texturing();
  pipeline::GivenFlow flow;
  const texture::TexturedSurface first =
      pipeline::textureFrame(made, {}, flow.next(pipeline::liquidOf(*ball(0.0), nullptr), kSeconds)).surface;
  const sim::Frame motion = flow.next(pipeline::liquidOf(*ball(0.0), nullptr), kSeconds);
  CHECK(motion.substeps.empty());
  const pipeline::TexturedFrame second = pipeline::textureFrame(made, first, motion);
  CHECK(second.synthesis.renewed < 0.002);
  REQUIRE(second.surface.positions.size() == first.positions.size());
  float farthest = 0.0f;
  for (std::size_t v = 0; v < first.positions.size(); ++v)
    farthest = std::max(farthest, (second.surface.positions[v] - first.positions[v]).length());
  CHECK(farthest < 0.01f * float(first.spacing));
}

TEST_CASE("given_flow: where one frame has no velocity, the other's moves the liquid", "[pipeline]") {
  for (const bool begin : {true, false}) {
    pipeline::GivenFlow flow;
    caches::LiquidFrame first = ofGrids(0.0), second = ofGrids(kSeconds);
    (begin ? second : first).velocity = {};
    const sim::FaceGrids known = begin ? first.velocity : second.velocity;
    flow.next(std::move(first), kSeconds);
    const sim::Frame motion = flow.next(std::move(second), kSeconds);
    REQUIRE(motion.substeps.size() == 1);
    CHECK(motion.substeps[0].dt == kSeconds);
    CHECK(motion.substeps[0].u == known.component[0]);
  }
}

TEST_CASE("given_flow: the level set may be of any place and voxels, and need be no distance", "[pipeline]") {
  const openvdb::FloatGrid::Ptr phi = ball(0.0);
  for (auto voxel = phi->beginValueOn(); voxel; ++voxel) voxel.setValue(*voxel * (5.0f + *voxel));
  const caches::LiquidFrame frame = pipeline::liquidOf(*phi, nullptr);
  CHECK_FALSE(frame.isSheet);
  CHECK(caches::areaOf(frame.surface) == Approx(4.0 * std::numbers::pi * kRadius * kRadius).epsilon(0.01));
  double volume = 0.0;
  const double h = frame.phi->voxelSize()[0];
  CHECK(h == Approx(kVoxel));
  const openvdb::Coord middle = openvdb::Coord::round(frame.phi->worldToIndex(centreAt(0.0)));
  for (auto cell = openvdb::CoordBBox(middle.offsetBy(-16), middle.offsetBy(16)).begin(); cell; ++cell)
    if (frame.phi->tree().getValue(*cell) < 0.0f) volume += h * h * h;
  CHECK(volume == Approx(4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3)).epsilon(0.02));
}

TEST_CASE("given_flow: says what is wrong with its input", "[pipeline]") {
  const caches::SurfaceTriangles mesh = caches::surfaceOfGrid(*ball(0.0), 0.0);
  const auto liquid = [](caches::SurfaceTriangles of, std::size_t velocities, double h) {
    pipeline::liquidOf(std::move(of), std::vector<Vec3f>(velocities, Vec3f(0.0f)), h, kSeconds);
  };
  CHECK_THROWS_WITH(liquid(mesh, 3, kVoxel), Contains("3 velocities"));
  CHECK_THROWS_WITH(liquid(mesh, 0, 0.0), Contains("cells of 0 m"));
  CHECK_THROWS_WITH(liquid(mesh, 0, 1e-7), Contains("too many"));
  caches::SurfaceTriangles broken = mesh;
  broken.triangles[0][1] = std::uint32_t(mesh.points.size());
  CHECK_THROWS_WITH(liquid(broken, 0, kVoxel), Contains("counted from 0"));
  broken = mesh;
  broken.points[5][2] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH(liquid(broken, 0, kVoxel), Contains("not finite"));
  const openvdb::FloatGrid::Ptr phi = ball(0.0);
  phi->setTransform(std::make_shared<openvdb::math::Transform>(
      std::make_shared<openvdb::math::ScaleMap>(Vec3d(0.1, 0.1, 0.2))));
  CHECK_THROWS_WITH(pipeline::liquidOf(*phi, nullptr), Contains("give cubes"));
  CHECK_THROWS_WITH(pipeline::GivenFlow().next(pipeline::liquidOf(*ball(0.0), nullptr), 0.0),
                    Contains("more than 0"));
}
