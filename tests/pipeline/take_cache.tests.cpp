#include "pipeline/take_cache.h"

#include "caches/layouts/numbered_files.h"
#include "tests/pipeline/written_caches.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using Catch::Contains;

TEST_CASE("take cache: what a scene does not say is what the files have") {
  const Scratch scratch;
  writeBalls(scratch.path, 5, 7);
  scenes::Scene scene = sceneIn(scratch.path);
  scene.onto.first = 11;
  const std::vector<std::string> lines = takeCache(scene);
  CHECK(scene.frames == 3);
  CHECK(scene.files.first == 5);
  CHECK(scene.onto.last == 13);
  CHECK_FALSE(scene.comesAsMeshes);
  CHECK(scene.files.voxel == Approx(kBallCell));
  // The bounds of the first ball and the last.
  CHECK(scene.domainOrigin.eq(Vec3d(1.0, 2.0, 3.0) - Vec3d(kBallRadius), 0.2 * kBallCell));
  CHECK(scene.sim.size.eq(Vec3d(2.0 * kBallRadius + 0.5, 2.0 * kBallRadius, 2.0 * kBallRadius),
                          0.4 * kBallCell));
  CHECK(scene.sim.resolution == int(std::ceil(scene.sim.size[0] / kBallCell)));
  // Seen from where the default view sees its domain, as large in the picture.
  const render::Camera& camera = scene.render.camera;
  CHECK(camera.at.eq(scene.domainOrigin + 0.5 * scene.sim.size, 1e-9));
  const Vec3d away = camera.from - camera.at, usual = render::Camera{}.from - render::Camera{}.at;
  CHECK(away.unit().eq(usual.unit(), 1e-9));
  CHECK(away.length() / scene.sim.size.length() == Approx(usual.length() / 1.6));
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  const Vec3d &size = scene.sim.size, &low = scene.domainOrigin;
  char found[100];
  std::snprintf(found, sizeof found, "size      %.3g x %.3g x %.3g m, from (%.3g, %.3g, %.3g) on", size[0],
                size[1], size[2], low[0], low[1], low[2]);
  CHECK_THAT(text, Contains(found));
  CHECK_THAT(text, Contains("cells     of 0.05 m; 24 frames a second"));
}

TEST_CASE("take cache: what a scene says stays") {
  const Scratch scratch;
  writeBalls(scratch.path, 1, 3);
  scenes::Scene scene = sceneIn(scratch.path);
  scene.frames = 2;
  scene.sim.size = Vec3d(5.0, 6.0, 7.0);
  scene.sim.resolution = 33;
  scene.render.camera.from = Vec3d(9.0, 8.0, 7.0);
  takeCache(scene);
  CHECK(scene.frames == 2);
  CHECK(scene.onto.last == scene.onto.first + 1);
  CHECK(scene.sim.size == Vec3d(5.0, 6.0, 7.0));
  CHECK(scene.sim.resolution == 33);
  CHECK(scene.domainOrigin == Vec3d(0.0));
  CHECK(scene.render.camera.from == Vec3d(9.0, 8.0, 7.0));
  CHECK(scene.render.camera.at.eq(Vec3d(1.25, 2.0, 3.0), 0.2 * kBallCell));
  scene.render.camera.at = Vec3d(1.0, 1.0, 1.0);
  takeCache(scene);
  CHECK(scene.render.camera.at == Vec3d(1.0, 1.0, 1.0));
}

TEST_CASE("take cache: around a drop there is a little room") {
  const Scratch scratch;
  writeBalls(scratch.path, 1, 1, 1.7 * kBallCell);
  scenes::Scene scene = sceneIn(scratch.path);
  takeCache(scene);
  CHECK(scene.sim.size.eq(Vec3d(4.0 * kBallCell), 1e-6));
  CHECK(scene.sim.resolution == 8);
}

TEST_CASE("take cache: more frames than there are files are refused, unless more files are to come") {
  const Scratch scratch;
  writeBalls(scratch.path, 5, 7);
  scenes::Scene scene = sceneIn(scratch.path);
  scene.frames = 4;
  CHECK_THROWS_AS(takeCache(scene), caches::LayoutError);
  CHECK_THROWS_WITH(takeCache(scene),
                    Contains("has 3 frames from number 5 on, and the scene 4; give frames = 3"));
  scene.files.follow = true;
  takeCache(scene);
  CHECK(scene.frames == 4);
  // How many there will be has to be said.
  scene.frames = 0;
  CHECK_THROWS_AS(takeCache(scene), caches::LayoutError);
  CHECK_THROWS_WITH(takeCache(scene), Contains("--set frames=N"));
}

TEST_CASE("take cache: a file that is missing is known before the run, if it is needed") {
  const Scratch scratch;
  writeBalls(scratch.path, 1, 5);
  std::filesystem::remove(scratch.path / "water_4.vdb");
  scenes::Scene scene = sceneIn(scratch.path);
  CHECK_THROWS_AS(takeCache(scene), caches::LayoutError);
  scene = sceneIn(scratch.path);
  scene.frames = 3;
  takeCache(scene);
  CHECK(scene.frames == 3);
}

TEST_CASE("take cache: what the texture follows has to be in the files") {
  const Scratch scratch;
  writeBalls(scratch.path, 1, 1);
  const auto refusal = [&](const auto& ask) {
    scenes::Scene scene = sceneIn(scratch.path);
    ask(scene.texture);
    try {
      takeCache(scene);
    } catch (const caches::LayoutError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal([](texture::Options& t) { t.guidance.by = texture::GuidanceBy::temperature; }).empty());
  CHECK(refusal([](texture::Options& t) { t.scale.by = texture::FactorBy::temperature; }).empty());
  CHECK_THAT(refusal([](texture::Options& t) {
               t.guidance.by = texture::GuidanceBy::attribute;
               t.guidance.attribute = "salt";
             }),
             Contains("texture.guidance.attribute: ") && Contains("has no salt; there are: temperature"));
  CHECK_THAT(refusal([](texture::Options& t) {
               t.scale.by = texture::FactorBy::attribute;
               t.scale.attribute = "dye";
             }),
             Contains("texture.scale.attribute: ") && Contains("has no dye"));
  CHECK_THAT(refusal([](texture::Options& t) {
               t.orientation.align = texture::Align::attribute;
               t.orientation.attribute = "fibre";
             }),
             Contains("texture.orientation.attribute: ") && Contains("has no fibre_x"));
}

TEST_CASE("take cache: recorded frames have the domain that they were made in") {
  const Scratch scratch;
  writePool(scratch.path, 2);
  scenes::Scene scene = sceneIn(scratch.path);
  const std::vector<std::string> lines = takeCache(scene);
  CHECK(scene.frames == 2);
  CHECK(scene.sim.size == pool().size);
  CHECK(scene.sim.resolution == 12);
  CHECK(scene.sim.sides == pool().sides);
  CHECK(scene.domainOrigin == Vec3d(0.0));
  CHECK(scene.render.camera.at.eq(0.5 * pool().size, 1e-9));
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Contains("recorded by fluidtex, frames 1 to 2"));
  scene.frames = 3;
  CHECK_THROWS_WITH(takeCache(scene), Contains("give frames = 2"));
  scene.frames = 2;
  scene.files.follow = true;
  CHECK_THROWS_AS(takeCache(scene), caches::LayoutError);
  CHECK_THROWS_WITH(takeCache(scene), Contains("does not wait for"));
}
