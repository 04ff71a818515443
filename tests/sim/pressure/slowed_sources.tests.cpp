#include "sim/pressure/slowed_sources.h"

#include "tests/sim/pressure/pressure_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

const Coord kSource(4, 4, 4), kFront(4, 4, 5);  // a cell, and its upper face normal to z

// A tank with a source of one cell that sends liquid upwards at 1 m/s. Its back is shut, and its sides stand
// still.
Scene withSource(const std::function<double(const Vec3d&)>& level) {
  Scene scene(8, {}, level);
  SolidField solid = *scene.solid;
  for (int axis = 0; axis < 3; ++axis) {
    solid.given.component[axis] = FloatGrid::create(kNotGiven);
    Coord next = kSource;
    next[axis] += 1;
    solid.given.component[axis]->tree().setValueOn(kSource, 0.0f);
    solid.given.component[axis]->tree().setValueOn(next, axis == 2 ? 1.0f : 0.0f);
  }
  scene.solid = std::make_shared<SolidField>(solid);
  return scene;
}

double frontSpeed(Scene& scene) {
  (void)scene.projected();
  return scene.velocity.component[2]->tree().getValue(kFront);
}

}  // namespace

TEST_CASE("slowed sources: what is full takes nothing more, and stays divergence-free", "[sim]") {
  Scene scene = withSource([](const Vec3d&) { return -1.0; });
  CHECK(std::abs(frontSpeed(scene)) < 1e-6);
  MaskGrid source;
  source.tree().setValueOn(kSource);
  CHECK(scene.largestDivergence(source) < 1e-5);
}

TEST_CASE("slowed sources: below a surface they give what they are told", "[sim]") {
  Scene scene = withSource([](const Vec3d& x) { return x[2] - 0.8; });
  CHECK(frontSpeed(scene) == 1.0);
}

TEST_CASE("slowed sources: they make up for what a solid that draws back leaves", "[sim]") {
  Scene scene = withSource([](const Vec3d&) { return -1.0; });
  const auto& c = scene.velocity.component;
  LiquidCells liquid =
      gatherLiquid(*scene.phi, *scene.solid, {&c[0]->constTree(), &c[1]->constTree(), &c[2]->constTree()});
  std::vector<int> all(liquid.numbering.size());
  double excess = 0.0;
  for (int n = 0; n < liquid.numbering.size(); ++n) excess -= liquid.outflow[all[n] = n];
  CHECK(excess == Approx(1.0));
  liquid.outflow[0] += 0.25;
  const FaceGrids slowed = slowedSources(*scene.solid, {all}, liquid);
  CHECK(slowed[2].tree().getValue(kFront) == Approx(0.25f));
  CHECK(scene.solid->given[2].tree().getValue(kFront) == 1.0f);
}

TEST_CASE("slowed sources: they take back what a full room was given too much, and give what it lacks",
          "[sim]") {
  for (const double each : {0.005, -0.005, 0.1}) {  // 1/s, of each of 511 cells
    Scene scene = withSource([](const Vec3d&) { return -1.0; });
    auto divergence = FloatGrid::create(0.0f);
    for (int n = 0; n < 512; ++n) {
      const Coord cell(n / 64, n / 8 % 8, n % 8);
      if (cell != kSource) divergence->tree().setValueOn(cell, static_cast<float>(each));
    }
    PressureOptions options;
    options.divergence = divergence;
    const Projection projected = scene.projected(options);
    const FloatTree& up = projected.expansion.component[2]->tree();
    CAPTURE(each);
    // No faster than the source gives.
    CHECK(up.getValue(kFront) == Approx(std::clamp(-511.0 * each * scene.h, -1.0, 1.0)).epsilon(1e-3));
    CHECK(std::abs(scene.velocity.component[2]->tree().getValue(kFront)) < 1e-6);
  }
}
