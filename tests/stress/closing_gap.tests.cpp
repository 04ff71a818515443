#include "tools/stress_scenes/closing_gap.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using sim::Vec3d;

namespace {

// A piston that moves from x = 0.2 by 0.5 m in a second towards a plate at x = 0.8, in a tank of 20 cells.
sim::Options press() {
  sim::Options options;
  options.resolution = 20;
  options.solids.resize(2);
  options.solids[0].shape = {sim::Box{Vec3d(-0.5, -0.5, -0.5), Vec3d(0.2, 1.5, 1.5)}};
  options.solids[0].keyframes.resize(2);
  options.solids[0].keyframes[1].time = 1.0;
  options.solids[0].keyframes[1].move = Vec3d(0.5, 0.0, 0.0);
  options.solids[1].shape = {sim::Box{Vec3d(0.8, -0.5, -0.5), Vec3d(0.9, 1.5, 1.5)}};
  return options;
}

}  // namespace

TEST_CASE("closing gap: a piston's way to the plate before it, and none once it stands", "[stress]") {
  sim::Options options = press();
  for (const double time : {0.0, 0.4, 0.9})
    CHECK(stress::closingGap(options, time) == Catch::Detail::Approx(0.6 - 0.5 * time).margin(0.003));
  CHECK(std::isinf(stress::closingGap(options, 1.2)));
  options.solids.pop_back();  // the far wall of the tank
  CHECK(stress::closingGap(options, 0.4) == Catch::Detail::Approx(0.6).margin(0.003));
  options.solids[0].keyframes[1].move = Vec3d(-0.2, 0.0, 0.0);  // away from it
  CHECK(std::isinf(stress::closingGap(options, 0.4)));
}
