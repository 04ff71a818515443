// Functions that are given what their headers rule out say so, in release builds too.
#include "sim/flows/move_surface.h"
#include "sim/heat/heat.h"
#include "sim/markers/markers.h"
#include "sim/motion/motion.h"
#include "sim/pressure/pressure.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/step/check_options.h"
#include "sim/step/step.h"
#include "sim/surface/level_set.h"
#include "sim/velocity/extrapolate.h"
#include "sim/viscosity/viscosity.h"
#include "sim/volume/deficit_grid.h"
#include "sim/volume/volume_deficit.h"
#include "tests/sim/step/solver_scenes.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

using namespace fluidtex::sim;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A block of liquid that moves evenly along x, by so many cells in a step of a second.
struct Block {
  double h = 1.0 / 16;
  FloatGrid::Ptr phi = makePhi(h, 6.0 * h);
  SolidField solid = *Solids(tank(16, {})).at(0.0);
  Velocity velocity;
  Markers markers;

  explicit Block(double cells) {
    const auto cube = [](const Vec3d& x) {
      const Vec3d away = x - Vec3d(0.5);
      return std::max({std::abs(away[0]), std::abs(away[1]), std::abs(away[2])}) - 0.2;
    };
    unite(*phi, cube, firstCells(Coord(16)));
    velocity = velocityField(h, phi->tree(), [&](const Vec3d&) { return Vec3d(cells * h, 0.0, 0.0); });
    markers = seedMarkers(*phi, *solid.phi, 0);
  }
};

}  // namespace

TEST_CASE("advectMarkers: what would move five cells or more in a step is refused", "[sim]") {
  Block slow(4.9);
  CHECK_FALSE(advectMarkers(slow.markers, slow.velocity, 1.0).empty());
  for (const double cells : {5.0, 6.5, 40.0, 1e9, kInfinity, std::nan("")}) {
    INFO(cells << " cells");
    Block fast(cells);
    CHECK_THROWS_AS(advectMarkers(fast.markers, fast.velocity, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(moveSurface(*fast.phi, fast.markers, {fast.velocity, fast.solid, 1.0, 1}),
                    std::invalid_argument);
  }
  // Backwards as well.
  Block back(-7.0);
  CHECK_THROWS_AS(advectMarkers(back.markers, back.velocity, 1.0), std::invalid_argument);
}

TEST_CASE("solver: a state without a surface or a velocity is refused", "[sim]") {
  CHECK_THROWS_AS(Solver(tank(8, {}), State{}), std::invalid_argument);
}

TEST_CASE("sim: time steps and properties that make no sense are refused", "[sim]") {
  Block block(0.0);
  for (const double wrong : {0.0, -1.0, std::nan("")}) {
    INFO(wrong);
    CHECK_THROWS_AS(project(block.velocity, *block.phi, block.solid, wrong, 1000.0), std::invalid_argument);
    CHECK_THROWS_AS(project(block.velocity, *block.phi, block.solid, 0.1, wrong), std::invalid_argument);
    CHECK_THROWS_AS(applyViscosity(block.velocity, *block.phi, block.solid, 0.1, wrong, {.constant = 1.0}),
                    std::invalid_argument);
    CHECK_THROWS_AS(targetDivergence(*block.phi, wrong), std::invalid_argument);
    Liquid liquid{block.phi, block.velocity, {}, 0, 0.0, {}};
    CHECK_THROWS_AS(step(liquid, {block.solid, block.solid, wrong, 0.1}, tank(16, {})),
                    std::invalid_argument);
  }
  CHECK_THROWS_AS(applyViscosity(block.velocity, *block.phi, block.solid, 0.1, 1000.0, {.constant = -1.0}),
                  std::invalid_argument);
  const FloatGrid::Ptr temperature = makeScalar(block.h, 300.0);
  CHECK_THROWS_AS(conductHeat(*temperature, *block.phi, block.solid, -0.1, 1000.0, {}),
                  std::invalid_argument);
  CHECK_THROWS_AS(conductHeat(*temperature, *block.phi, block.solid, 0.1, 0.0, {}), std::invalid_argument);
  CHECK_THROWS_AS(visibleSurface(*block.phi, block.solid, 0), std::invalid_argument);
  CHECK_THROWS_AS(extrapolate(std::vector<Extrapolated>{}, *block.phi, *block.solid.phi),
                  std::invalid_argument);
}
