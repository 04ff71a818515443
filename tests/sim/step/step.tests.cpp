#include "sim/step/step.h"

#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::sim;

TEST_CASE("step: the capillary limit goes with h^(3/2), and there is none without tension", "[sim]") {
  Options options = tank(32, {});
  CHECK(capillaryStep(options) == std::numeric_limits<double>::infinity());
  options.surfaceTension = 0.07;
  options.density = 1000.0;
  const double limit = capillaryStep(options), h = options.voxelSize();
  // Brackbill, Kothe, Zemach, 1992: dt^2 = <rho> h^3 / (2 pi sigma), <rho> the mean of both sides' densities.
  CHECK(limit == Approx(std::sqrt(0.5 * 1000.0 * h * h * h / (2.0 * M_PI * 0.07))));
  options.resolution = 128;
  CHECK(capillaryStep(options) == Approx(limit / 8.0));
}

TEST_CASE("step: a drop in the open is accelerated by gravity, to the middle of the next step", "[sim]") {
  const Options options = tank(32, {{Shape{Sphere{Vec3d(0.5), 0.15}}, Vec3d(0.0), 0.0}});
  Solver solver(options);
  solver.next();
  Liquid liquid = solver.state();
  const auto solid = Solids(options).at(0.0);
  const double dt = 0.04, nextDt = 0.02, before = liquid.velocity[2].tree().getValue(Coord(16, 16, 16)),
               offset = liquid.leapfrogOffset;
  const std::int64_t steps = liquid.steps;
  StepReport report;
  const auto later = step(liquid, {*solid, *solid, dt, nextDt}, options, &report);
  REQUIRE(later);
  CHECK(report.pressure.converged);
  CHECK(later->steps == steps + 1);
  CHECK(later->leapfrogOffset == Approx(0.5 * nextDt));
  // From `offset` after the old phi to nextDt / 2 after the new one.
  CHECK(later->velocity[2].tree().getValue(Coord(16, 16, 16)) - before ==
        Approx(options.gravity[2] * (dt + 0.5 * nextDt - offset)).epsilon(1e-3));
}

TEST_CASE("step: what a short step changes at once is no force that lasts through a long one", "[sim]") {
  Options options = tank(24, {{Shape{Sphere{Vec3d(0.5), 0.2}}, Vec3d(0.0), 0.0}});
  options.gravity = Vec3d(0.0);
  Solver solver(options);
  solver.next();
  Liquid liquid = solver.state();
  // Halves of the drop run into each other.
  for (auto it = liquid.velocity.component[0]->beginValueOn(); it; ++it)
    it.setValue(it.getCoord()[0] < 12 ? 1.0f : -1.0f);
  const auto solid = Solids(options).at(0.0);
  const double dt = 1e-5, nextDt = 0.04;
  auto met = step(liquid, {*solid, *solid, dt, nextDt}, options);
  REQUIRE(met);
  const double fastest = maxAbs(met->velocity);
  const auto later = step(*met, {*solid, *solid, nextDt, nextDt}, options);
  REQUIRE(later);
  CHECK(maxAbs(later->velocity) < fastest);
}
