#include "pipeline/orientation_guide.h"

#include "tests/scratch.h"
#include "tests/texture/mesh/closed_meshes.h"
#include "texture/orientation/directions.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using texture::Align;
using texture::Vec3f;

namespace {

scenes::Scene aligned(Align align, double weight = 1.0, double angle = 0.0) {
  scenes::Scene scene;
  scene.texture.orientation.align = align;
  scene.texture.orientation.weight = weight;
  scene.texture.orientation.angle = angle;
  return scene;
}

std::vector<Vec3f> wishedBy(const scenes::Scene& scene, const texture::SurfaceMesh& mesh,
                            const sim::Frame& frame = {}) {
  const OrientationGuide guide = orientationGuide(scene);
  const texture::OrientWishes wishes = wishesFor(guide, frame);
  REQUIRE(wishes.direction);
  CHECK_FALSE(wishes.stiffness);
  return wishes.direction(mesh);
}

void checkWished(const std::vector<Vec3f>& found, const std::vector<Vec3f>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t v = 0; v < found.size(); ++v) CHECK((found[v] - expected[v]).length() < 1e-5f);
}

// A liquid that moves as one.
sim::Frame movingFrame(const openvdb::Vec3d& velocity) {
  openvdb::initialize();
  sim::Frame frame;
  sim::Substep substep;
  substep.dt = 0.04;
  for (int axis = 0; axis < 3; ++axis) {
    const auto grid = sim::FloatGrid::create(0.0f);
    const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
    openvdb::Vec3d shift(0.0);
    shift[axis] = -0.125;
    transform->postTranslate(shift);
    grid->setTransform(transform);
    grid->denseFill(openvdb::CoordBBox(openvdb::Coord(-12), openvdb::Coord(12)), float(velocity[axis]));
    (axis == 0 ? substep.u : axis == 1 ? substep.v : substep.w) = grid;
  }
  frame.substeps.push_back(substep);
  return frame;
}

}  // namespace

TEST_CASE("orientation guide: a scene that asks for nothing has no wishes") {
  const sim::Frame frame;
  for (const scenes::Scene& scene : {aligned(Align::none), aligned(Align::gravity, 0.0)}) {
    const OrientationGuide guide = orientationGuide(scene);
    const texture::OrientWishes wishes = wishesFor(guide, frame);
    CHECK_FALSE(wishes.direction);
    CHECK_FALSE(wishes.stiffness);
  }
}

TEST_CASE("orientation guide: downhill, along a direction and around bends, as strong as the weight") {
  const texture::SurfaceMesh mesh = testing::torusMesh(40, 16);
  const auto weighted = [](std::vector<Vec3f> directions, float weight) {
    for (Vec3f& x : directions) x *= weight;
    return directions;
  };
  scenes::Scene scene = aligned(Align::gravity, 0.25);
  scene.sim.gravity = sim::Vec3d(0.0, 0.0, -3.7);
  checkWished(wishedBy(scene, mesh), weighted(texture::alongDirection(mesh, Vec3f(0, 0, -1)), 0.25f));
  scene = aligned(Align::direction, 0.5);
  scene.texture.orientation.direction = openvdb::Vec3d(1.0, 2.0, 0.0);
  checkWished(wishedBy(scene, mesh), weighted(texture::alongDirection(mesh, Vec3f(1, 2, 0)), 0.5f));
  checkWished(wishedBy(aligned(Align::curvature, 0.75), mesh), weighted(texture::alongBend(mesh), 0.75f));
}

TEST_CASE("orientation guide: the angle is counter-clockwise, seen from outside") {
  const texture::SurfaceMesh box = testing::boxMesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  scenes::Scene scene = aligned(Align::direction, 0.5, 30.0);
  const std::vector<Vec3f> wished = wishedBy(scene, box);
  const auto c = float(0.5 * std::sqrt(0.75)), s = 0.25f;
  int seen = 0;
  for (std::size_t v = 0; v < wished.size(); ++v) {
    if (std::abs(box.normals[v].z()) < 0.999f) continue;
    ++seen;
    CHECK((wished[v] - Vec3f(c, box.normals[v].z() > 0.0f ? s : -s, 0.0f)).length() < 1e-6f);
  }
  CHECK(seen == 18);
}

TEST_CASE("orientation guide: along the flow, half where it takes twenty frames for a spacing") {
  const texture::SurfaceMesh box = testing::boxMesh({-1, -1, -1}, {1, 1, 1}, {4, 4, 4});
  scenes::Scene scene = aligned(Align::flow);
  scene.sim.frameRate = 30.0;
  const double speed = box.spacing * 30.0 / 20.0;
  const std::vector<Vec3f> wished = wishedBy(scene, box, movingFrame({0.0, speed, 0.0}));
  const std::vector<Vec3f> thrice = wishedBy(scene, box, movingFrame({0.0, 3.0 * speed, 0.0}));
  int upper = 0;
  for (std::size_t v = 0; v < wished.size(); ++v) {
    if (box.normals[v].z() < 0.999f) continue;
    ++upper;
    CHECK((wished[v] - Vec3f(0.0f, 0.5f, 0.0f)).length() < 1e-5f);
    CHECK((thrice[v] - Vec3f(0.0f, 0.9f, 0.0f)).length() < 1e-5f);
  }
  CHECK(upper == 9);
  // Nothing has moved yet.
  for (const Vec3f& x : wishedBy(scene, box, {})) CHECK(x == Vec3f(0.0f));
}

TEST_CASE("orientation guide: along a volume of vectors from a file, and a file without one is refused") {
  openvdb::initialize();
  const Scratch scratch;
  const texture::SurfaceMesh mesh = testing::sphereMesh(4);
  scenes::Scene scene = aligned(Align::field);
  scene.texture.orientation.field = scratch.path / "wind.vdb";
  CHECK_THROWS_WITH(orientationGuide(scene), Catch::Contains("wind.vdb: "));
  openvdb::io::File((scratch.path / "wind.vdb").string())
      .write({openvdb::Vec3SGrid::create(Vec3f(0.0f, -2.0f, 0.0f))});
  checkWished(wishedBy(scene, mesh), texture::alongDirection(mesh, Vec3f(0, -1, 0)));
}

TEST_CASE("orientation guide: the liquid's own vectors are turned as its files are") {
  openvdb::initialize();
  const texture::SurfaceMesh mesh = testing::sphereMesh(4);
  sim::Frame frame;
  frame.fields["fibre_x"] = sim::FloatGrid::create(0.5f);
  frame.fields["fibre_y"] = sim::FloatGrid::create(2.0f);
  scenes::Scene scene = aligned(Align::attribute);
  scene.texture.orientation.attribute = "fibre";
  CHECK_THROWS_WITH(wishedBy(scene, mesh, frame), Catch::Contains("no fibre_z"));
  frame.fields["fibre_z"] = sim::FloatGrid::create(1.0f);
  checkWished(wishedBy(scene, mesh, frame), texture::alongDirection(mesh, Vec3f(0.5f, 2.0f, 1.0f)));
  // Y up: what was z points to the viewer, along -y.
  scene.files.up = sim::UpAxis::y;
  checkWished(wishedBy(scene, mesh, frame), texture::alongDirection(mesh, Vec3f(0.5f, -1.0f, 2.0f)));
}

TEST_CASE(
    "orientation guide: turning costs a hundred times as much in shapes, as much as ever a spacing away") {
  texture::SurfaceMesh mesh;
  mesh.spacing = 0.2;
  mesh.positions = {{0, 0, 0},     {0.9f, 0, 0}, {1.0f, 0, 0}, {1.1f, 0, 0},
                    {1.15f, 0, 0}, {1.2f, 0, 0}, {3.1f, 0, 0}, {2.1f, 9, 0}};
  scenes::Scene scene = aligned(Align::none);
  for (const double x : {0.0, 4.0}) scene.keepClear.push_back({sim::Sphere{sim::Vec3d(x, 0, 0), 1.0}});
  const OrientationGuide guide = orientationGuide(scene);
  const sim::Frame frame;
  const texture::OrientWishes wishes = wishesFor(guide, frame);
  CHECK_FALSE(wishes.direction);
  REQUIRE(wishes.stiffness);
  const std::vector<float> stiffness = wishes.stiffness(mesh);
  const std::vector<float> expected{100.0f, 100.0f, 100.0f, 50.5f, 25.75f, 1.0f, 100.0f, 1.0f};
  REQUIRE(stiffness.size() == expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v) CHECK(stiffness[v] == Approx(expected[v]).margin(1e-3));
}
