#include "pipeline/texture_guidance.h"

#include "tests/scratch.h"
#include "tests/texture/mesh/closed_meshes.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using texture::GuidanceBy;
using texture::Vec3f;

namespace {

scenes::Scene sceneBy(GuidanceBy by, double low, double high) {
  scenes::Scene scene;
  scene.texture.guidance.by = by;
  scene.texture.guidance.points = {{low, 0.0}, {high, 1.0}};
  return scene;
}

// What is wanted on a ball of radius 1 around the origin.
texture::SurfaceMesh guided(GuidanceBy by, double low, double high, const sim::Frame& frame = {},
                            const texture::Carried& carried = {}) {
  texture::Surface surface;
  surface.levels.push_back(testing::sphereMesh(8));
  guide(textureGuidance(sceneBy(by, low, high)), frame, carried, 0.1, surface);
  if (by != GuidanceBy::none)
    REQUIRE(surface.levels[0].guidance.size() == surface.levels[0].positions.size());
  return surface.levels[0];
}

std::vector<float> levelsOf(const texture::SurfaceMesh& mesh) {
  return mesh.guidance;
}

// Turns about the z axis, 3 radians a second.
sim::Frame turningFrame() {
  openvdb::initialize();
  sim::Frame frame;
  sim::Substep substep;
  substep.dt = 0.1;
  const double h = 0.25;
  const openvdb::CoordBBox box(openvdb::Coord(-12), openvdb::Coord(12));
  const auto component = [&](int axis, const auto& value) {
    const auto grid = sim::FloatGrid::create(0.0f);
    const auto transform = openvdb::math::Transform::createLinearTransform(h);
    openvdb::Vec3d shift(0.0);
    shift[axis] = -0.5 * h;
    transform->postTranslate(shift);
    grid->setTransform(transform);
    for (auto c = box.begin(); c; ++c) grid->tree().setValue(*c, float(value(transform->indexToWorld(*c))));
    return grid;
  };
  substep.u = component(0, [](const openvdb::Vec3d& x) { return -3.0 * x.y(); });
  substep.v = component(1, [](const openvdb::Vec3d& x) { return 3.0 * x.x(); });
  substep.w = component(2, [](const openvdb::Vec3d&) { return 0.0; });
  frame.substeps.push_back(substep);
  return frame;
}

}  // namespace

TEST_CASE("texture guidance: by nothing there is none") {
  CHECK(guided(GuidanceBy::none, 0, 1).guidance.empty());
}

TEST_CASE("texture guidance: by height and by curvature") {
  const texture::SurfaceMesh height = guided(GuidanceBy::height, -1.0, 1.0);
  for (std::size_t v = 0; v < height.guidance.size(); ++v)
    CHECK(height.guidance[v] == Approx(0.5f * (1.0f + height.positions[v].z())).margin(1e-6));
  for (const float level : levelsOf(guided(GuidanceBy::curvature, 0.0, 2.0)))
    CHECK(level == Approx(0.5f).epsilon(0.01));
}

TEST_CASE("texture guidance: by speed and by vorticity, both 0 where nothing has moved yet") {
  const sim::Frame turning = turningFrame();
  const texture::SurfaceMesh speed = guided(GuidanceBy::speed, 0.0, 3.0, turning);
  for (std::size_t v = 0; v < speed.guidance.size(); ++v) {
    const Vec3f& x = speed.positions[v];
    CHECK(speed.guidance[v] == Approx(std::hypot(x.x(), x.y())).margin(1e-3));
  }
  for (const float level : levelsOf(guided(GuidanceBy::vorticity, 0.0, 12.0, turning)))
    CHECK(level == Approx(0.5f).margin(1e-3));
  for (const GuidanceBy by : {GuidanceBy::speed, GuidanceBy::vorticity})
    for (const float level : levelsOf(guided(by, 0.0, 1.0))) CHECK(level == 0.0f);
}

TEST_CASE("texture guidance: by temperature, by a painted volume") {
  openvdb::initialize();
  sim::Frame hot;
  const auto grid = sim::FloatGrid::create(300.0f);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(-8, -8, 0), openvdb::Coord(8)), 500.0f);
  hot.fields["temperature"] = grid;
  const texture::SurfaceMesh heat = guided(GuidanceBy::temperature, 300.0, 700.0, hot);
  for (std::size_t v = 0; v < heat.guidance.size(); ++v)
    if (heat.positions[v].z() >= 0.0f) CHECK(heat.guidance[v] == Approx(0.5f));

  const Scratch folder;
  const auto painted = openvdb::FloatGrid::create(2.0f);
  openvdb::io::File((folder.path / "paint.vdb").string()).write({painted});
  scenes::Scene scene = sceneBy(GuidanceBy::field, 1.0, 3.0);
  scene.texture.guidance.field = folder.path / "paint.vdb";
  texture::Surface surface;
  surface.levels.push_back(testing::sphereMesh(2));
  guide(textureGuidance(scene), {}, {}, 0.1, surface);
  for (const float level : surface.levels[0].guidance) CHECK(level == 0.5f);
}

TEST_CASE("texture guidance: by age, which starts anew where surface has just come to light") {
  texture::Carried carried;
  const std::size_t count = testing::sphereMesh(8).positions.size();
  carried.age.assign(count, 2.0f);
  carried.trust.assign(count, 1.0f);
  carried.trust[7] = 0.0f;
  const texture::SurfaceMesh age = guided(GuidanceBy::age, 0.0, 4.0, {}, carried);
  CHECK(age.guidance[6] == Approx(0.5f));
  CHECK(age.guidance[7] == 0.0f);
  const texture::SurfaceMesh renewal = guided(GuidanceBy::renewal, 0.0, 4.0, {}, carried);
  CHECK(renewal.guidance[6] == Approx(0.5f));
  CHECK(renewal.guidance[7] == 0.0f);
  for (const float level : levelsOf(guided(GuidanceBy::renewal, 0.0, 4.0))) CHECK(level == 0.0f);
}

TEST_CASE("texture guidance: by foam, which is handed on") {
  const std::size_t count = testing::sphereMesh(8).positions.size();
  texture::Carried carried;
  carried.foam.assign(count, 0.5f);
  carried.trust.assign(count, 1.0f);
  const texture::SurfaceMesh calm = guided(GuidanceBy::foam, 0.0, 1.0, {}, carried);
  const auto left = float(0.5 * std::exp(-0.1 / texture::Foam{}.lifetime));  // a tenth of a second later
  REQUIRE(calm.foam.size() == count);
  CHECK(calm.foam[3] == Approx(left));
  CHECK(calm.guidance[3] == Approx(left));
  CHECK(guided(GuidanceBy::age, 0.0, 1.0).foam.empty());
}
