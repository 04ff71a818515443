#include "pipeline/foreseen_surface.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex;

namespace {

// A square tap, 16 of 64 cells a side, over a dry floor of 1 m.
scenes::Scene tap(double speed, int frames) {
  scenes::Scene scene;
  scene.frames = frames;
  scene.sim.resolution = 64;
  scene.texture.points = 40000;
  sim::Source source;
  source.shape.kind = sim::Box{{0.375, 0.375, 0.8}, {0.625, 0.625, 0.95}};
  source.velocity = {0.0, 0.0, -speed};
  scene.sim.sources.push_back(source);
  return scene;
}

}  // namespace

TEST_CASE("foreseen surface: a source brings its front times its velocity times its time", "[pipeline]") {
  const double front = 0.0625;
  CHECK(pipeline::inflow(tap(1.0, 73)) == Approx(3.0 * front));
  CHECK(pipeline::inflow(tap(1.0, 1)) == 0.0);
  scenes::Scene scene = tap(2.0, 73);
  scene.sim.sources[0].from = 1.0;
  scene.sim.sources[0].until = 2.0;
  CHECK(pipeline::inflow(scene) == Approx(2.0 * front));
  // Level before the curve and after it: half a second of nothing, one of half, one and a half of all.
  scene = tap(1.0, 73);
  scene.sim.sources[0].rate = {{0.5, 0.0}, {1.5, 1.0}};
  CHECK(pipeline::inflow(scene) == Approx(2.0 * front));
  // Along no axis: as much as the shape shows of itself in that direction; of a ball, its disc.
  scene = tap(1.0, 25);
  scene.sim.resolution = 256;
  scene.sim.sources[0].shape.kind = sim::Sphere{{0.5, 0.5, 0.5}, 0.2};
  scene.sim.sources[0].velocity = {1.0, 1.0, -1.0};
  CHECK(pipeline::inflow(scene) == Approx(3.0 * std::numbers::pi * 0.04).epsilon(0.03));
}

TEST_CASE("foreseen surface: a little spreads to a sheet, much fills the domain's floor", "[pipeline]") {
  const double little = pipeline::inflow(tap(0.05, 73));
  CHECK(pipeline::foreseenSurface(tap(0.05, 73)) == Approx(2.0 * little * 64));
  const double much = pipeline::inflow(tap(2.0, 73));
  CHECK(pipeline::foreseenSurface(tap(2.0, 73)) == Approx(2.0 + 4.0 * much));
  CHECK(pipeline::foreseenSpacing(tap(2.0, 73)) == Approx(std::sqrt((2.0 + 4.0 * much) / 40000.0)));
  // No more than the domain holds.
  CHECK(pipeline::foreseenSurface(tap(1e4, 73)) == Approx(6.0));
}

TEST_CASE("foreseen surface: nothing where all is there from the start, all bodies where one is poured later",
          "[pipeline]") {
  scenes::Scene scene = tap(1.0, 73);
  scene.sim.sources.clear();
  scene.sim.liquid.push_back({{sim::Sphere{{0.5, 0.5, 0.5}, 0.3}}});
  CHECK(pipeline::foreseenSurface(scene) == 0.0);
  CHECK(pipeline::foreseenSpacing(scene) == 0.0);
  scene.sim.liquid[0].from = 0.5;
  CHECK(pipeline::foreseenSurface(scene) == Approx(4.0 * std::numbers::pi * 0.09).epsilon(0.1));
}
