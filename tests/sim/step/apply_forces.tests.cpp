#include "sim/step/apply_forces.h"

#include "sim/step/solver.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::sim;

namespace {

// A pool as the solver leaves it, with its solids.
struct Pool {
  Options options = tank(16, {{Shape{Box{Vec3d(0.0), Vec3d(1.0, 1.0, 0.47)}}, Vec3d(0.0), 0.0}});
  std::shared_ptr<const SolidField> solid;
  Liquid liquid;

  Pool() {
    Solver solver(options);
    solver.next();
    liquid = solver.state();
    solid = Solids(options).at(0.0);
  }
  bool press(double dt, StepReport* report = nullptr) {
    return applyPressure(liquid, *solid, {.dt = dt, .kick = dt}, options, {}, report);
  }
  float& velocityAt(int axis, const Coord& face) {
    auto* leaf = liquid.velocity.component[axis]->tree().touchLeaf(face);
    return leaf->buffer().data()[FloatLeaf::coordToOffset(face)];
  }
};

}  // namespace

TEST_CASE(
    "apply pressure: a pool that gravity has driven down stands still, with the pressure's cells told") {
  Pool pool;
  for (auto it = pool.liquid.velocity.component[2]->beginValueOn(); it; ++it) it.setValue(-0.0981f);
  StepReport report;
  REQUIRE(pool.press(0.01, &report));
  CHECK(report.pressure.converged);
  CHECK(report.pressure.cells == 16 * 16 * 8);
  CHECK(fastestOf(State{pool.liquid}) < 1e-5);
}

TEST_CASE("apply pressure: a velocity that is not finite is no step") {
  Pool pool;
  pool.velocityAt(2, Coord(5, 5, 3)) = std::numeric_limits<float>::infinity();
  CHECK_FALSE(pool.press(0.01));
}

TEST_CASE("apply viscosity: the report says whether it was solved, and a pool at rest stays so") {
  Pool pool;
  StepReport report;
  pool.options.viscosity = 100.0;
  REQUIRE(applyViscosityFor(pool.liquid, *pool.solid, 0.01, pool.options, nullptr, report));
  CHECK(report.viscosity.converged);
  CHECK(fastestOf(State{pool.liquid}) < 1e-5);
}
