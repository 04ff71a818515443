#include "sim/surface/settle_surface.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

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
