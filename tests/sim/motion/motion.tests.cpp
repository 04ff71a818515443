#include "sim/motion/motion.h"

#include "sim/step/state_io.h"
#include "tests/scratch.h"
#include "tests/sim/motion/ball.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("motion: a flow goes on from its state as if it had not stopped", "[sim]") {
  Options options = ball(Vec3d(0.35), 0.15);
  const MotionOptions motion{MotionKind::deformation};
  const Scratch scratch;
  Motion whole = makeMotion(options, motion);
  CHECK(warningsOf(whole).empty());
  nextFrame(whole);
  nextFrame(whole);
  writeState(stateOf(whole), scratch.path / "state.vdb");
  Motion rest = makeMotion(options, motion, readState(scratch.path / "state.vdb"));
  const Frame expected = nextFrame(whole), found = nextFrame(rest);
  CHECK(found.index == 3);
  CHECK(found.substeps.size() == expected.substeps.size());
  auto a = expected.surfacePhi->cbeginValueOn(), b = found.surfacePhi->cbeginValueOn();
  for (; a; ++a, ++b) REQUIRE((b && a.getCoord() == b.getCoord() && *a == *b));
  options.resolution = 24;
  CHECK_THROWS_AS(makeMotion(options, motion, readState(scratch.path / "state.vdb")), SolverError);
}

TEST_CASE("motion: what is asked for is made, and solids are warned of without it", "[sim]") {
  Options options = ball(Vec3d(0.5), 0.2);
  options.resolution = 16;
  CHECK(std::holds_alternative<Solver>(makeMotion(options, {})));
  CHECK(std::holds_alternative<AnalyticFlow>(makeMotion(options, {MotionKind::rotation})));
  options.solids.resize(1);
  options.solids[0].name = "far";
  options.solids[0].shape = {Sphere{Vec3d(9.0), 0.5}};
  CHECK(warningsOf(options, {}).size() == 1);
  CHECK(warningsOf(options, {}) == warningsOf(makeMotion(options, {})));
}
