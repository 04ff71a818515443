#include "tools/frames/time_plan.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using tools::plannedTime;

TEST_CASE("time plan: grows with cells, points, ways and paths, and shrinks with threads", "[tools]") {
  scenes::Scene scene;
  scene.sim.size = {1, 1, 1};
  const pipeline::LiquidPlan liquid{.cells = 100000, .atStart = 100000, .surfaceCells = 10000};
  const tools::PlannedTime one = plannedTime(scene, liquid, 40000, 65536, 1);
  CHECK(one.simulate > 0.0);
  CHECK(one.firstTexture > one.texture);
  CHECK(plannedTime(scene, liquid, 80000, 65536, 1).texture == Approx(2.0 * one.texture));
  CHECK(plannedTime(scene, liquid, 40000, 65536, 8).frame() < one.frame() / 4.0);
  scenes::Scene other = scene;
  other.render.noise = 0.0;
  other.render.smooth = false;
  const double all = plannedTime(other, liquid, 40000, 65536, 1).render;
  other.render.samples *= 4;
  CHECK(plannedTime(other, liquid, 40000, 65536, 1).render == Approx(4.0 * all));
  other.render.noise = 0.01;
  CHECK(plannedTime(other, liquid, 40000, 65536, 1).render == Approx(0.75 * all));  // 24 of 32 paths
  other = scene;
  other.sim.resolution *= 2;  // twice the substeps, of as many cells
  CHECK(plannedTime(other, liquid, 40000, 65536, 1).simulate == Approx(2.0 * one.simulate));
  other = scene;
  other.texture.orientation.symmetry = 4;
  other.texture.orientation.mirrored = true;
  CHECK(plannedTime(other, liquid, 40000, 65536, 1).texture > 1.5 * one.texture);
  other = scene;
  other.motion.flow = sim::MotionKind::rest;
  CHECK(plannedTime(other, liquid, 40000, 65536, 1).simulate == 0.0);
}

TEST_CASE("time plan: only ways that cost much are told of", "[tools]") {
  texture::OrientationOptions orientation;
  CHECK(tools::waysNote(orientation).empty());
  orientation.symmetry = 2;
  CHECK(tools::waysNote(orientation).empty());
  orientation.symmetry = 4;
  orientation.mirrored = true;
  CHECK_THAT(tools::waysNote(orientation), Catch::Contains("8 ways") && Catch::Contains("3 times as long"));
}
