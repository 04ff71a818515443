#include "tools/stress_scenes/impact.h"

#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "tools/stress_scenes/measures.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using sim::Vec3d;

namespace {

// A layer at the bottom of a tank, without weight, that is poured with this velocity.
sim::Options layer(const Vec3d& velocity, int resolution) {
  sim::Options options;
  options.resolution = resolution;
  options.gravity = Vec3d(0.0);
  options.liquid.push_back({{sim::Box{Vec3d(0.0), Vec3d(1.0, 1.0, 0.25)}}, velocity});
  return options;
}

// m/s as the first frame begins, of the fastest cell.
double fastestAtFirst(const sim::Options& options) {
  sim::Solver solver(options);
  sim::Solids solids(options);
  solver.next();
  const auto field = solids.around({solver.state().phi.get()}, 0.0, solids.active(0.0));
  return stress::measure(solver.state(), *field, options).speed.value;
}

}  // namespace

TEST_CASE("impact: a wall drives liquid out as the solver does, two walls twice as fast", "[stress]") {
  for (const int resolution : {16, 32}) {
    const sim::Options one = layer(Vec3d(1.0, 0.0, 0.0), resolution);
    const sim::Options two = layer(Vec3d(1.0, 1.0, 0.0), resolution);
    CAPTURE(resolution);
    CHECK(stress::impactSpeed(one) == Approx(fastestAtFirst(one)).epsilon(0.15));
    CHECK(stress::impactSpeed(two) == Approx(fastestAtFirst(two)).epsilon(0.2));
    CHECK(stress::impactSpeed(two) == Approx(2.0 * stress::impactSpeed(one)));
  }
}

TEST_CASE("impact: none of liquid that touches no wall, leaves it or runs along it", "[stress]") {
  CHECK(stress::impactSpeed(layer(Vec3d(0.0, 0.0, 1.0), 16)) == 0.0);
  sim::Options beside = layer(Vec3d(0.0, 1.0, 0.0), 16);
  beside.liquid[0].shape = {sim::Box{Vec3d(0.0, 0.3, 0.0), Vec3d(1.0, 0.6, 0.25)}};
  CHECK(stress::impactSpeed(beside) == 0.0);
  sim::Options open = layer(Vec3d(1.0, 0.0, 0.0), 16);
  open.sides[1] = sim::Side::open;
  CHECK(stress::impactSpeed(open) == 0.0);
  // A sloping wall stops what goes into it.
  sim::Options sloping = beside;
  sloping.solids.resize(1);
  sloping.solids[0].shape = {sim::HalfSpace{Vec3d(0.0, 0.55, 0.0), Vec3d(0.0, -1.0, 1.0)}};
  CHECK(stress::impactSpeed(sloping) > 0.5);
}
