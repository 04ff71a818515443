#include "tools/frames/color_between.h"

#include "tests/scratch.h"
#include "tests/tools/halves.h"

#include <catch2/catch.hpp>

#include <functional>
#include <vector>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Contains;
using texture::Vec3f;
using texture::Vec4f;
namespace fs = std::filesystem;

namespace {

// Black left of the middle and white right of it.
fs::path writeHalves(const fs::path& file, int width, int height) {
  return fluidtex::writeHalves(file, width, height, {0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f});
}

texture::Options lookedUp(const fs::path& exemplar) {
  texture::Options options;
  options.exemplar.file = exemplar;
  options.exemplar.between = texture::Between::exemplar;
  return options;
}

// Two triangles on an exemplar of 16 x 12 texels: one in its left half, one in its right, far from all edges.
texture::TexturedSurface twoTriangles() {
  texture::TexturedSurface surface;
  surface.exemplarWidth = 16;
  surface.exemplarHeight = 12;
  for (const float x : {0.0f, 8.0f}) {
    surface.positions.insert(surface.positions.end(),
                             {{x, 0.0f, 0.0f}, {x + 1, 0.0f, 0.0f}, {x, 1.0f, 0.0f}});
    surface.coordinate.insert(surface.coordinate.end(),
                              {{3.0f + x, 5.0f}, {4.0f + x, 5.0f}, {3.0f + x, 6.0f}});
  }
  surface.gradient.assign(6, {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}});
  surface.triangles = {{0, 1, 2}, {3, 4, 5}};
  return surface;
}

}  // namespace

TEST_CASE("color between: looked up where coordinates are transported, and colours are not", "[tools]") {
  using texture::LaterFrames;
  using texture::Method;
  texture::Options options;
  const auto with = [&](Method method, LaterFrames later) {
    options.synthesis.method = method;
    options.laterFrames = later;
    return looksUp(options);
  };
  CHECK(with(Method::coordinates, LaterFrames::synthesize));
  CHECK(with(Method::coordinates, LaterFrames::alone));
  for (const LaterFrames later : {LaterFrames::advect, LaterFrames::birth, LaterFrames::dualRest})
    CHECK_FALSE(with(Method::coordinates, later));
  CHECK_FALSE(with(Method::kwatra07, LaterFrames::synthesize));
  CHECK_FALSE(with(Method::none, LaterFrames::synthesize));
}

TEST_CASE("color between: joints only where colours are looked up", "[tools]") {
  texture::TexturedSurface surface = twoTriangles();
  surface.coordinate[4] = {2.0f, 9.0f};  // another piece
  texture::Options options;
  const texture::Joints joints = jointsOf(options, surface);
  REQUIRE(joints.joints.size() == 1);
  CHECK(joints.joints[0].triangle == 1);
  options.laterFrames = texture::LaterFrames::advect;
  CHECK(jointsOf(options, surface).joints.empty());
  options = {};
  options.synthesis.method = texture::Method::kwatra07;
  CHECK(jointsOf(options, surface).joints.empty());
}

TEST_CASE("color between: a piece goes on over the edge of an exemplar that is toroidal", "[tools]") {
  texture::TexturedSurface surface = twoTriangles();
  surface.triangles.pop_back();
  surface.coordinate[0] = surface.coordinate[2] = {15.25f, 5.0f};
  surface.coordinate[2][1] = 6.0f;
  surface.coordinate[1] = {0.5f, 5.0f};  // a quarter of a texel beyond where the gradient leads
  texture::Options options;
  const auto placeOfSecond = [&] {
    const texture::Joints joints = jointsOf(options, surface);
    REQUIRE(joints.joints.size() == 1);
    return joints.joints[0].shown[0][1][0];
  };
  CHECK(placeOfSecond() == Approx(16.25));  // of another piece: by the gradient
  options.exemplar.toroidal = true;
  CHECK(placeOfSecond() == Approx(16.5));  // of the same: its own
}

TEST_CASE("color between: the exemplar or the finer picture is read where it is asked for", "[tools]") {
  const Scratch scratch;
  texture::Options options = lookedUp(writeHalves(scratch.path / "a.png", 16, 12));
  options.exemplar.betweenFile = writeHalves(scratch.path / "fine.png", 64, 48);
  options.exemplar.toroidal = true;
  const std::optional<texture::Detail> own = detailOf(options);
  REQUIRE(own);
  CHECK(own->color.width == 16);
  CHECK(own->color.height == 12);
  CHECK(own->toroidal);
  CHECK_FALSE(own->seeThrough);
  options.exemplar.between = texture::Between::file;
  options.exemplar.toroidal = false;
  const std::optional<texture::Detail> fine = detailOf(options);
  REQUIRE(fine);
  CHECK(fine->color.width == 64);
  CHECK(fine->color.height == 48);
  CHECK_FALSE(fine->toroidal);
  // Means are taken over as much of the exemplar, four of whose pixels make one here.
  CHECK(fine->halvings == own->halvings + 2);
}

TEST_CASE("color between: no picture is read where none is looked up", "[tools]") {
  texture::Options options = lookedUp("/nowhere/a.png");
  CHECK_THROWS_AS(detailOf(options), texture::ExemplarError);
  options.laterFrames = texture::LaterFrames::advect;
  CHECK_FALSE(detailOf(options));
  options = lookedUp("/nowhere/a.png");
  options.synthesis.method = texture::Method::none;
  CHECK_FALSE(detailOf(options));
  options = lookedUp("/nowhere/a.png");
  options.exemplar.between = texture::Between::points;
  CHECK_FALSE(detailOf(options));
}

TEST_CASE("color between: a finer picture has the exemplar's shape, but for a pixel", "[tools]") {
  const Scratch scratch;
  texture::Options options = lookedUp(writeHalves(scratch.path / "a.png", 16, 12));
  options.exemplar.between = texture::Between::file;
  options.exemplar.betweenFile = scratch.path / "fine.png";
  for (const int height : {23, 25}) {
    writeHalves(options.exemplar.betweenFile, 32, height);
    CHECK(detailOf(options));
  }
  for (const int height : {22, 26}) {
    writeHalves(options.exemplar.betweenFile, 32, height);
    CHECK_THROWS_AS(detailOf(options), texture::ExemplarError);
    CHECK_THROWS_WITH(
        detailOf(options),
        Contains("fine.png has 32 x " + std::to_string(height) + " pixels") && Contains("a.png 16 x 12"));
  }
  fs::remove(options.exemplar.betweenFile);
  CHECK_THROWS_AS(detailOf(options), texture::ExemplarError);
}

TEST_CASE("color between: the picture's colour at the place in the triangle that is asked for", "[tools]") {
  const Scratch scratch;
  texture::TexturedSurface surface = twoTriangles();
  const texture::Options options = lookedUp(writeHalves(scratch.path / "a.png", 16, 12));
  const std::optional<texture::Detail> detail = detailOf(options);
  const texture::Joints joints = jointsOf(options, surface);
  CHECK_FALSE(bool(colorBetween(std::nullopt, surface, joints)));
  const render::ColorBetween between = colorBetween(detail, surface, joints);
  REQUIRE(bool(between));
  const Vec3f middle(1.0f / 3.0f);
  CHECK(between(0, middle) == Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
  CHECK(between(1, middle) == Vec4f(1.0f, 1.0f, 1.0f, 1.0f));
  // From a corner in the left half to one in the right.
  surface.coordinate[1] = {12.0f, 5.0f};
  CHECK(colorBetween(detail, surface, {})(0, {1.0f, 0.0f, 0.0f}) == Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
  CHECK(colorBetween(detail, surface, {})(0, {0.0f, 1.0f, 0.0f}) == Vec4f(1.0f, 1.0f, 1.0f, 1.0f));
}

TEST_CASE("view: of the frame, and bare where nothing is textured", "[tools]") {
  scenes::Scene scene;
  scene.sim.size = {2, 1, 3};
  scene.domainOrigin = {-1, 0, 0};
  scene.frames = 5;
  const texture::TexturedSurface surface;
  const texture::Joints joints;
  const render::View view = tools::viewOfFrame(scene, 2, std::nullopt, surface, joints);
  CHECK(view.domainSize == render::Vec3d(2, 1, 3));
  CHECK(view.domainOrigin == render::Vec3d(-1, 0, 0));
  CHECK(view.progress == 0.25);
  CHECK(view.frame == 2);
  CHECK_FALSE(view.colorBetween);
  CHECK_FALSE(view.seeThrough);
  CHECK(view.textured);
  scene.texture.synthesis.method = texture::Method::none;
  scene.frames = 1;
  CHECK_FALSE(tools::viewOfFrame(scene, 1, std::nullopt, surface, joints).textured);
  CHECK(tools::viewOfFrame(scene, 1, std::nullopt, surface, joints).progress == 0.0);
}
