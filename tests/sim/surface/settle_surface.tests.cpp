#include "sim/surface/settle_surface.h"

#include "sim/surface/level_set.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("settle surface: what was poured level is level, a distance, and goes on behind the walls",
          "[sim]") {
  Options options;
  options.resolution = 24;
  const double h = options.voxelSize(), level = 10.3 * h;
  const SolidField solid = *Solids(options).at(0.0);
  FloatGrid::Ptr phi = makePhi(h, 6.0 * h);
  // Slopes of a third, as where only a bound of the distance is known.
  unite(
      *phi, [&](const Vec3d& x) { return (x[2] - level) / 3.0; }, grown(solid.domain, 4));
  settleSurface(*phi, solid);
  for (int i = -2; i < 26; ++i) {
    for (int k = 9; k < 13; ++k) {
      CAPTURE(i, k);
      CHECK(std::abs(phi->tree().getValue(Coord(i, 12, k)) - ((k + 0.5) * h - level)) < 0.05 * h);
    }
  }
}

TEST_CASE("settle surface: the level goes on into a block just above it, below a gap that is a cell wide",
          "[sim]") {
  Options options;
  options.resolution = 16;
  const double h = options.voxelSize();
  options.liquid.push_back({{Box{Vec3d(0.0), Vec3d(1.0, 1.0, 5.23 * h)}}});
  options.solids.resize(2);
  options.solids[0].shape = {Box{Vec3d(5.21, 4.2, 1.0) * h, Vec3d(11.2, 9.9, 5.29) * h}};
  options.solids[1].shape = {Box{Vec3d(4.92, 6.15, 5.92) * h, Vec3d(10.3, 13.1, 8.0) * h}};
  Solver solver(options);
  double fastest = 0.0;
  for (int n = 0; n < 2; ++n) {
    solver.next();
    fastest = std::max(fastest, fastestOf(solver.state()));
  }
  CHECK(fastest < 0.01 * std::sqrt(options.gravity.length() * h));
}
