// The scene that ships, in all its qualities.
#include "scenes/scene.h"

#include <catch2/catch.hpp>

#include <filesystem>

namespace fluidtex::scenes {

namespace {

Scene damBreak(Quality quality) {
  Overrides overrides;
  overrides.quality = quality;
  return loadScene(FLUIDTEX_SOURCE_DIR "/scenes/dam_break.toml", overrides);
}

}  // namespace

TEST_CASE("dam break: is read in every quality, with an exemplar that is there", "[scenes]") {
  for (const Quality quality : {Quality::preview, Quality::standard, Quality::final}) {
    const Scene scene = damBreak(quality);
    CHECK(scene.name == "dam_break");
    CHECK(scene.frames == 72);
    CHECK(std::filesystem::is_regular_file(scene.texture.exemplar.file));
    CHECK(scene.texture.exemplar.toroidal);
  }
}

TEST_CASE("dam break: size and cost of each quality", "[scenes]") {
  const Scene preview = damBreak(Quality::preview), standard = damBreak(Quality::standard),
              final = damBreak(Quality::final);
  CHECK(preview.texture.points < standard.texture.points);
  CHECK(standard.texture.points >= 42000);
  CHECK(final.texture.points == 500000);
  CHECK(preview.sim.resolution < standard.sim.resolution);
  CHECK(standard.sim.resolution < final.sim.resolution);
  CHECK(standard.render.width == 960);
  CHECK(standard.render.height == 540);
  CHECK(final.render.width == 1920);
  CHECK(preview.render.samples < standard.render.samples);
}

TEST_CASE("dam break: an invisible wall stands between the water and the dry half, until the water is let go",
          "[scenes]") {
  for (const Quality quality : {Quality::preview, Quality::standard, Quality::final}) {
    const sim::Options sim = damBreak(quality).sim;
    REQUIRE(sim.solids.size() == 1);
    const sim::Solid& gate = sim.solids[0];
    CHECK_FALSE(gate.visible);
    CHECK(gate.from == 0.0);
    CHECK(gate.until < 72 / sim.frameRate);
    const auto& wall = std::get<sim::Box>(gate.shape.kind);
    CHECK(wall.max.x() - wall.min.x() >
          1.9 * sim.voxelSize());  // thick enough for the grid to hold back liquid
    CHECK(wall.min.y() <= 0.0);
    CHECK(wall.max.y() >= sim.size.y());
    CHECK(wall.min.z() <= 0.0);
    CHECK(wall.max.z() >= sim.size.z());
    REQUIRE(sim.liquid.size() == 2);
    for (const sim::LiquidBody& body : sim.liquid)
      CHECK(std::get<sim::Box>(body.shape.kind).max.x() <= wall.min.x());
    const auto& pool = std::get<sim::Box>(sim.liquid[0].shape.kind);
    const auto& block = std::get<sim::Box>(sim.liquid[1].shape.kind);
    CHECK(block.min.z() > pool.max.z() + 2.0 * sim.voxelSize());  // apart at the start
    CHECK(block.max.z() < sim.size.z());
  }
}

}  // namespace fluidtex::scenes
