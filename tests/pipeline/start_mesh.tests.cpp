#include "pipeline/start_mesh.h"

#include "pipeline/texture_frame.h"
#include "render/render.h"
#include "scenes/figures/vase.h"
#include "sim/shapes/shape_distance.h"
#include "tests/scratch.h"
#include "texture/frames/renewal.h"
#include "texture/labels/labels.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <numbers>

using namespace fluidtex;
using texture::Vec2f;
using texture::Vec3f;

namespace {

// A square of 2 m in the plane z = 0, whose picture's left half it shows.
const std::string kSquare =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

// A scene that begins with a mesh, and the folder it lies in.
struct Beginning {
  Scratch folder;
  scenes::Scene scene;
  explicit Beginning(const std::string& obj) {
    scene.start.mesh.file = folder.path / "m.obj";
    std::ofstream(scene.start.mesh.file) << obj;
  }
};

// A picture in which every texel tells where it is.
texture::Image gradientPicture(int size) {
  texture::Image picture{size, size, 4, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const float value : {float(x) / float(size), float(y) / float(size), 0.5f, 1.0f})
        picture.data.push_back(value);
  return picture;
}

// The vase as a liquid, in two frames at rest.
std::vector<sim::Frame> standingVase(const sim::MeshShape& mesh) {
  constexpr double kVoxel = 0.0125;
  const sim::ShapeDistance distance(sim::Shape{mesh}, kVoxel,
                                    openvdb::BBoxd(sim::Vec3d(-0.5), sim::Vec3d(1.0)));
  auto phi = openvdb::FloatGrid::create(float(3.0 * kVoxel));
  phi->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel));
  phi->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = phi->getAccessor();
  for (const auto& cell : openvdb::CoordBBox(openvdb::Coord(-20, -20, -4), openvdb::Coord(20, 20, 44))) {
    const double d = distance(phi->indexToWorld(cell));
    if (std::abs(d) < 3.0 * kVoxel)
      accessor.setValue(cell, float(d));
    else if (d < 0.0)
      accessor.setValueOff(cell, float(-3.0 * kVoxel));
  }
  sim::Frame first;
  first.surfacePhi = phi;
  sim::Frame second = first;
  second.index = 2;
  second.time = 1.0 / 24.0;
  return {first, second};
}

}  // namespace

TEST_CASE("start mesh: places, gradients and the spacing are the picture's on the mesh", "[pipeline]") {
  const Beginning beginning(kSquare);
  const texture::TexturedSurface surface = pipeline::startSurface(beginning.scene, 80, 40);
  REQUIRE(surface.triangles.size() == 2);
  // Half of 80 and all of 40 pixels on 2 m each.
  CHECK(surface.spacing == Approx(0.05));
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const Vec3f& x = surface.positions[v];
    CHECK(surface.normals[v] == Vec3f(0, 0, 1));
    CHECK((surface.coordinate[v] - Vec2f(20.0f * x.x() - 0.5f, 20.0f * (2.0f - x.y()) - 0.5f)).length() <
          1e-4f);
    CHECK((surface.gradient[v].s - Vec3f(20, 0, 0)).length() < 1e-3f);
    CHECK((surface.gradient[v].t - Vec3f(0, -20, 0)).length() < 1e-3f);
    CHECK(texture::stretch(surface.gradient[v], surface.spacing) == Approx(1.0f).epsilon(1e-4));
  }
  CHECK(pipeline::startSurface({}, 80, 40).empty());
}

TEST_CASE("start mesh: a mesh whose places span no area is refused", "[pipeline]") {
  const Beginning beginning("v 0 0 0\nv 2 0 0\nv 2 2 0\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/1\n");
  CHECK_THROWS_WITH(pipeline::startSurface(beginning.scene, 80, 40),
                    Catch::Contains("m.obj: its texture coordinates span no area"));
}

TEST_CASE("start mesh: what of the picture it shows", "[pipeline]") {
  const Beginning beginning(kSquare);
  const texture::Image shown =
      pipeline::shownByStart(pipeline::startSurface(beginning.scene, 80, 40), 80, 40, false);
  REQUIRE(shown.channels == 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 80; ++x) {
      INFO(x << " " << y);
      CHECK(*shown.at(x, y) == (x < 42 ? 1.0f : 0.0f));
    }
  // All of it: nothing to tell apart.
  std::string whole = kSquare;
  for (std::size_t at = whole.find("0.5"); at != whole.npos; at = whole.find("0.5"))
    whole.replace(at, 3, "1");
  const Beginning all(whole);
  CHECK(pipeline::shownByStart(pipeline::startSurface(all.scene, 80, 40), 80, 40, false).data.empty());
  CHECK(pipeline::shownByStart({}, 80, 40, false).data.empty());
  // Where it is repeated, what lies beyond an edge is shown at the other.
  std::string beyond = kSquare;
  for (std::size_t at = beyond.find("vt 0 "); at != beyond.npos; at = beyond.find("vt 0 ", at + 1))
    beyond.replace(at, 5, "vt -0.25 ");
  const Beginning left(beyond);
  const texture::Image around =
      pipeline::shownByStart(pipeline::startSurface(left.scene, 80, 40), 80, 40, true);
  CHECK((*around.at(70, 20) == 1.0f && *around.at(10, 20) == 1.0f && *around.at(50, 20) == 0.0f));
}

TEST_CASE("start mesh: the picture is halved until its pixels on the mesh are the points", "[pipeline]") {
  Beginning beginning(kSquare);
  scenes::Scene& scene = beginning.scene;
  scene.texture.exemplar.file = beginning.folder.path / "p.png";
  render::Picture picture{200, 100, std::vector<float>(200 * 100 * 3, 0.5f)};
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = float(i % 7) / 7.0f;
  render::writePng(picture, scene.texture.exemplar.file);
  scene.texture.synthesis.windows = {9, 5};
  scene.texture.points = 600;  // of the 10,000 pixels that the mesh shows
  scene.sim.size = sim::Vec3d(2.0);
  scenes::Scene given = scene, tiny = scene;
  pipeline::fitToStart(scene);
  CHECK(scene.texture.exemplar.halvings == 2);
  CHECK(scene.texture.spacing == Approx(0.08));
  pipeline::fitToStart(scene);
  CHECK(scene.texture.exemplar.halvings == 2);
  const pipeline::Texturing made = pipeline::makeTexturing(scene);
  CHECK(made.synthesizer.exemplar.color.width == 50);
  CHECK(made.synthesizer.exemplar.guided);
  CHECK(made.start.exemplarWidth == 50);
  CHECK(made.start.spacing == Approx(0.08));

  given.texture.spacing = 0.045;
  pipeline::fitToStart(given);
  CHECK(given.texture.exemplar.halvings == 1);
  CHECK(given.texture.spacing == Approx(0.04));
  tiny.start.mesh.place.scale = 1e-4;
  CHECK_THROWS_WITH(pipeline::fitToStart(tiny), Catch::Contains("m.obj: a pixel of its picture is") &&
                                                    Catch::Contains("is its scale right?"));
}

TEST_CASE("start mesh: a liquid begins with exactly the picture, and keeps it", "[pipeline]") {
  Beginning beginning(figures::objOf(figures::makeVase()));
  scenes::Scene& scene = beginning.scene;
  scene.texture.synthesis.windows = {9, 5};
  scene.texture.surface.levels = 2;
  scene.start.renew = GENERATE(false, true);
  constexpr int kSize = 96;
  pipeline::Texturing texturing = pipeline::makeTexturing(
      scene, texture::makeExemplar(gradientPicture(kSize), false, scene.texture.synthesis, 2));
  const std::vector<sim::Frame> frames = standingVase(scene.start.mesh);
  const texture::TexturedSurface first = pipeline::textureFrame(texturing, {}, frames[0]).surface;
  REQUIRE(first.original.size() == first.positions.size());
  CHECK(first.spacing == texturing.start.spacing);
  std::size_t original = 0, wall = 0;
  for (std::size_t v = 0; v < first.positions.size(); ++v) {
    original += first.original[v];
    const Vec3f& x = first.positions[v];
    if (!first.original[v] || x.z() < 0.05f || x.z() > 0.45f) continue;
    ++wall;
    // Around the wall the picture goes once; both of its ends are one place there.
    double around = std::atan2(double(x.y()), double(x.x())) / (2.0 * std::numbers::pi) * kSize - 0.5;
    const double off = double(first.coordinate[v][0]) - around;
    CHECK(std::abs(off - kSize * std::round(off / kSize)) < 0.6);
    CHECK(first.age[v] == 0.0f);
  }
  CHECK(double(original) > 0.97 * double(first.positions.size()));
  CHECK(wall > 1000);

  const texture::TexturedSurface second = pipeline::textureFrame(texturing, first, frames[1]).surface;
  std::size_t still = 0;
  for (const std::uint8_t flag : second.original) still += flag;
  if (scene.start.renew)
    // At the neck the picture is squeezed to half its width; at the belly it stays.
    CHECK((still < original && still > original / 3));
  else
    CHECK(double(still) > 0.995 * double(original));
}
