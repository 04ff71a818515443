#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "tests/sim/step/solver_scenes.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

// A tank 1 x 0.25 x 0.5 m with a wall across that comes from the left.
Options piston(double depth, double speed) {
  Options options;
  options.size = Vec3d(1.0, 0.25, 0.5);
  options.resolution = 32;
  options.cfl = 1.0;
  options.liquid = {{Shape{Box{Vec3d(-1.0), Vec3d(2.0, 1.0, depth)}}, Vec3d(0.0), 0.0}};
  Solid wall;
  wall.shape.kind = Box{Vec3d(-1.0), Vec3d(0.105, 1.0, 1.0)};
  wall.keyframes = {{0.1, Vec3d(0.0), 0.0}, {1.1, Vec3d(speed, 0.0, 0.0), 0.0}};
  options.solids = {wall};
  return options;
}

}  // namespace

TEST_CASE("moving solids: a piston pushes all the liquid before it") {
  Solver solver(piston(0.21, 0.1));
  const double first = solver.next().stats.volume;
  CHECK(first == Approx((1.0 - 0.105) * 0.25 * 0.21).epsilon(0.01));
  // What is left is the level set's own: waves run to and fro.
  for (int n = 2; n <= 30; ++n) CHECK(std::abs(solver.next().stats.volume / first - 1.0) < 0.015);
}

TEST_CASE("moving solids: the liquid's velocity is the piston's where the tank is full") {
  // Open at the far end: all of it moves as one.
  Options options = piston(0.6, 0.25);
  options.sides[1] = Side::open;
  options.gravity = Vec3d(0.0);
  options.surfaceTension = 1.0;  // without it, nothing would hold the liquid to the walls
  Solver solver(options);
  double first = solver.next().stats.volume, last = first;
  for (int n = 2; n <= 13; ++n) last = solver.next().stats.volume;
  const State& state = solver.state();
  for (int i = 12; i <= 32; i += 4)
    CHECK(std::abs(state.velocity.component[0]->tree().getValue(Coord(i, 4, 8)) - 0.25) < 1e-5);
  // 0.4 s of 0.25 m/s over the tank's cross-section.
  CHECK((first - last) / (0.4 * 0.25 * 0.125) == Approx(1.0).epsilon(1e-4));
  // Cells cut by the piston have no deficit.
  double deficit = 0.0;
  for (auto it = state.deficit->cbeginValueOn(); it; ++it) deficit = std::max(deficit, std::abs(double(*it)));
  CHECK(deficit < 1e-4);
}

TEST_CASE("moving solids: what sinks into a full basin lifts its surface by its volume") {
  Options options;
  options.resolution = 24;
  options.cfl = 1.0;
  options.liquid = {{Shape{Box{Vec3d(-1.0), Vec3d(2.0, 2.0, 0.45)}}, Vec3d(0.0), 0.0}};
  Solid ball;
  ball.shape.kind = Sphere{Vec3d(0.5, 0.5, 0.75), 0.2};
  ball.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(0.0, 0.0, -0.5), 180.0}};
  options.solids = {ball};
  Solver solver(options);
  const double first = solver.next().stats.volume;
  for (int n = 2; n <= 30; ++n) CHECK(std::abs(solver.next().stats.volume / first - 1.0) < 0.02);
}

TEST_CASE("solids: one too thin for the cells is told of, others are not") {
  Options options;
  options.resolution = 32;
  Solid thin, thick, gone;
  thin.name = "sheet";
  thin.shape.kind = Box{Vec3d(0.31, -1.0, -1.0), Vec3d(0.32, 2.0, 2.0)};
  thick.shape.kind = Box{Vec3d(0.5, -1.0, -1.0), Vec3d(0.57, 2.0, 2.0)};
  gone.shape.kind = Sphere{Vec3d(5.0), 1.0};
  options.solids = {thin, thick, gone};
  const auto warnings = Solids(options).warnings();
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Catch::StartsWith("solid \"sheet\" is only about 0.01"));
  CHECK_THAT(warnings[1], Catch::StartsWith("solid 2 is nowhere in the domain"));
}

TEST_CASE("moving solids: limit the steps also far from the liquid", "[sim]") {
  // In free space, where phi has no leaves but the liquid's.
  Options options;
  options.resolution = 16;
  options.sides.fill(Side::unbounded);
  options.gravity = Vec3d(0.0);
  options.liquid = {{Shape{Sphere{Vec3d(0.5), 0.3}}, Vec3d(0.0), 0.0}};
  options.solids = std::vector<Solid>(1);
  options.solids[0].shape = {Sphere{Vec3d(20.0, 0.5, 0.5), 0.3}};
  options.solids[0].keyframes = {{.time = 0.0}, {.time = 1.0, .move = Vec3d(-15.0, 0.0, 0.0)}};
  Solver solver(options);
  solver.next();
  CHECK(solver.next().stats.dtMin <= 1.0 / 16.0 / 15.0 * (1.0 + 1e-6));
}

TEST_CASE("moving solids: behind a piston that leaves a gap there is air, alike on any number of threads") {
  Options options = tank(26, {box(Vec3d(0.0), Vec3d(1.0, 0.5, 0.2))});
  options.size = Vec3d(1.0, 0.5, 0.6);
  options.solids.resize(1);
  // Its back stands two cells behind the domain's side; the liquid reaches under it as poured.
  options.solids[0].shape = {Box{Vec3d(-0.077, -0.077, -0.077), Vec3d(0.097, 0.6, 0.8)}};
  options.solids[0].keyframes = {{0.0, Vec3d(0.0), 0.0}, {0.6, Vec3d(0.21, 0.0, 0.0), 0.0}};
  const auto run = [&](int threads) {
    return onThreads(threads, [&] {
      Solver solver(options);
      for (int n = 0; n < 15; ++n) solver.next();
      return solver.state();
    });
  };
  const State one = run(1), two = run(2);
  CHECK(same(*one.phi, *two.phi));
  // The back has come to 0.13, three cells.
  int phantom = 0;
  for (int j = 0; j < 13; ++j)
    for (int k = 0; k < 15; ++k)
      for (int i = 0; i < 2; ++i) phantom += one.phi->tree().getValue(Coord(i, j, k)) < 0.0f;
  CHECK(phantom == 0);
}
