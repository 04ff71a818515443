#include "tools/benchmarks/closed_dam_break.h"

#include "sim/step/solver.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("closed dam break: a fifth of a cubic metre of liquid without friction in a box with a lid",
          "[benchmarks]") {
  const sim::Options options = benchmarks::closedDamBreak(20);
  CHECK(options.voxelSize() == 1.0 / 20.0);
  CHECK(options.size == sim::Vec3d(1.0));
  for (int side = 0; side < 6; ++side) {
    CHECK(options.sides[std::size_t(side)] == sim::Side::wall);
    CHECK(options.wallOf(side).kind == sim::WallKind::slip);
  }
  CHECK(options.viscosity == 0.0);
  CHECK(options.surfaceTension == 0.0);
  CHECK(options.frameRate == 24.0);
  CHECK(options.cfl == 4.0);
  // Its sides lie on those of cells.
  const sim::FrameStats stats = sim::Solver(options).next().stats;
  CHECK(stats.cells == 8 * 20 * 10);
  CHECK(stats.volume == Approx(0.2).epsilon(2e-3));
}
