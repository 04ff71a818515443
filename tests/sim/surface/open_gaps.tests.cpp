#include "sim/surface/open_gaps.h"

#include "sim/step/solver.h"
#include "tests/sim/solids/solid_scenes.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr int kCells = 16;
constexpr double kVoxel = 1.0 / kCells;

// Liquid in the upper half of a tank, against its ceiling, after a step in which gravity drove it like this.
// The value is phi in the first cell behind the ceiling.
float behindCeiling(bool separating, const Vec3d& kick) {
  const SolidField solid = *Solids(tankWith(kCells)).at(0.0);
  FloatGrid::Ptr phi = makePhi(kVoxel, 6.0 * kVoxel);
  unite(
      *phi, [](const Vec3d& x) { return 0.5 - x[2]; }, grown(solid.domain, 8));
  const Velocity still = velocityField(kVoxel, phi->tree(), [](const Vec3d&) { return Vec3d(0.0); });
  const MaskGrid::Ptr mask = MaskGrid::create();
  if (separating) mask->tree().fill(CoordBBox(Coord(0, 0, kCells - 1), Coord(kCells - 1)), true, true);
  openGaps(*phi, still, solid, *mask, kick, 0.01);
  return phi->tree().getValue(Coord(8, 8, kCells));
}

}  // namespace

TEST_CASE("open gaps: liquid that separates from a ceiling ends there, other liquid goes on behind it",
          "[sim]") {
  const Vec3d down(0.0, 0.0, -0.1);
  CHECK(behindCeiling(true, down) > 0.0f);
  CHECK(behindCeiling(false, Vec3d(0.0)) < 0.0f);
  CHECK(behindCeiling(false, -down) < 0.0f);
}

TEST_CASE("open gaps: water leaves a ceiling that is thinner than a cell") {
  // Layers of liquid under a plate across a tank; h is 1.
  const auto [thickness, above, depth] =
      GENERATE(table<double, double, double>({{0.6, 0.1, 4.0}, {0.8, 0.7, 2.5}, {1.1, 0.7, 1.5}}));
  Options options;
  options.size = Vec3d(12.0, 12.0, 24.0);
  options.resolution = 24;
  options.frameRate = 10.0;
  const double under = 12.0 + above;
  Solid plate;
  plate.shape = {Box{Vec3d(-1.0, -1.0, under), Vec3d(13.0, 13.0, under + thickness)}};
  options.solids.push_back(plate);
  options.liquid.push_back({{Box{Vec3d(0.0, 0.0, under - depth), Vec3d(12.0, 12.0, under)}}});
  const double whole = 144.0 * depth;
  Solver solver(options);
  Frame frame;
  for (int n = 0; n < 8; ++n) frame = solver.next();
  INFO(thickness << " cells: deficit " << frame.stats.deficit << " of " << whole);
  CHECK(std::abs(frame.stats.deficit) < 0.25 * whole);
  // The cells beside the plate are air.
  for (int n = 12; n <= 13; ++n) CHECK(solver.state().phi->tree().getValue(Coord(5, 5, n)) > 0.0f);
}
