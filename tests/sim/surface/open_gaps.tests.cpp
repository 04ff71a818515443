#include "sim/surface/open_gaps.h"

#include "tests/sim/solids/solid_scenes.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

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
