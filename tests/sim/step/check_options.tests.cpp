#include "sim/step/check_options.h"

#include "sim/motion/motion.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

using namespace fluidtex::sim;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("check options: settings that the solver cannot work with are refused", "[sim]") {
  const Options good = tank(8, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.5))});
  CHECK(&checked(good) == &good);
  CHECK_NOTHROW(Solver(good));
  const std::function<void(Options&)> spoil[] = {
      [](Options& o) { o.size = Vec3d(1.0, 0.0, 1.0); },
      [](Options& o) { o.size = Vec3d(1.0, -1.0, 1.0); },
      [](Options& o) { o.size = Vec3d(kInfinity, 1.0, 1.0); },
      [](Options& o) { o.resolution = 0; },
      [](Options& o) { o.density = 0.0; },
      [](Options& o) { o.density = std::nan(""); },
      [](Options& o) { o.viscosity = -1.0; },
      [](Options& o) { o.surfaceTension = -0.1; },
      [](Options& o) { o.gravity = Vec3d(0.0, 0.0, kInfinity); },
      [](Options& o) { o.cfl = 0.0; },
      [](Options& o) { o.frameRate = 0.0; },
      [](Options& o) { o.heat.simulated = true, o.heat.capacity = 0.0; },
      [](Options& o) { o.heat.simulated = true, o.heat.conductivity = -1.0; },
      [](Options& o) { o.heat.simulated = true, o.heat.ambient = -1.0; },
  };
  int number = 0;
  for (const auto& change : spoil) {
    INFO("change " << number++);
    Options bad = good;
    change(bad);
    CHECK_THROWS_AS(checked(bad), std::invalid_argument);
    CHECK_THROWS_AS(Solver(bad), std::invalid_argument);
    CHECK_THROWS_AS(Solver(bad, State{}), std::invalid_argument);
  }
  Options bad = good;
  bad.frameRate = -24.0;
  CHECK_THROWS_AS(makeMotion(bad, {.flow = MotionKind::rotation}), std::invalid_argument);
}
