// Viscous liquid at rest: see the derivation in sim/viscosity/viscous_step.h.
#include "sim/viscosity/viscous_step.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("viscous step: a pool rests, whatever its viscosity and walls, also where walls cut cells") {
  const WallKind kind = GENERATE(WallKind::slip, WallKind::friction, WallKind::noSlip);
  const double viscosity = GENERATE(0.0, 1.0, 100.0, 1e6);
  Options options = tank(16, {box(Vec3d(0.0), Vec3d(1.0, 0.53, 0.31))});
  options.size = Vec3d(1.0, 0.53, 0.77);  // 8.48 and 12.32 cells
  options.viscosity = viscosity;
  options.walls = {{DomainFace::all, {.kind = kind, .slipLength = 0.02}}};
  Solver solver(options);
  const double first = solver.next().stats.volume;
  CAPTURE(int(kind), viscosity);
  CHECK(fastestOf(solver.state()) < 1e-5);
  for (int n = 0; n < 10; ++n) {
    const Frame frame = solver.next();
    REQUIRE(fastestOf(solver.state()) < 1e-5);
    REQUIRE(std::abs(frame.stats.volume / first - 1.0) < 1e-5);
  }
}

TEST_CASE("viscous step: liquid in a narrow gap between a ball and a wall rests") {
  const double gap = GENERATE(0.7, 0.8, 0.9, 1.1, 1.3, 1.6);
  constexpr double wide = 0.2;  // 32 cells
  Options options = tank(32, {box(Vec3d(0.0), Vec3d(0.2, 0.2, 0.078))});
  options.size = Vec3d(0.2, wide, 0.125);
  options.viscosity = 0.011;
  options.density = 63.0;
  options.frameRate = 54.0;
  options.solids.resize(1);
  options.solids[0].shape = {Sphere{Vec3d(0.146737, wide - 0.0215791 - gap * 0.00625, 0.0304209), 0.0215791}};
  CAPTURE(gap);
  Solver solver(options);
  for (int n = 0; n < 6; ++n) {
    solver.next();
    REQUIRE(fastestOf(solver.state()) < 1e-5);
  }
}

TEST_CASE("viscous step: liquid over a no-slip column whose surfaces pass through faces' centres rests") {
  const double radius = GENERATE(2.0, 2.5);
  Options options = tank(12, {box(Vec3d(0.0), Vec3d(12.0, 12.0, 6.0))});
  options.size = Vec3d(12.0);
  options.viscosity = 1000.0;
  options.frameRate = 5.0;
  options.solids.resize(1);
  options.solids[0].shape = {Cylinder{Vec3d(6.5, 6.5, -1.0), Vec3d(6.5, 6.5, 5.0), radius}};
  options.solids[0].wall.kind = WallKind::noSlip;
  CAPTURE(radius);
  Solver solver(options);
  for (int n = 0; n < 3; ++n) {
    solver.next();
    REQUIRE(fastestOf(solver.state()) < 1e-3);
  }
}

TEST_CASE("viscous step: nothing is touched where it is negligible") {
  Options options = tank(8, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.5))});
  Solver solver(options);
  solver.next();
  const State& state = solver.state();
  Velocity velocity{copyOf(state.velocity)};
  Solids solids(options);
  const ViscousStepReport report = applyViscousStep(velocity, *state.phi, *solids.at(0.0), 0.01, 1000.0,
                                                    {.constant = 1e-3, .variable = nullptr}, {});
  CHECK(report.viscosity.skipped);
  CHECK(report.converged());
  for (int a = 0; a < 3; ++a) CHECK(same(*velocity.component[a], *state.velocity.component[a]));
}
