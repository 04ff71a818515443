#include "sim/step/describe_liquid.h"

#include "sim/surface/level_set.h"
#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("describe liquid: what is seen, what there is of it, and what stands in it", "[sim]") {
  // A pool half a metre deep with a block in it that is a quarter of the tank wide each way.
  const Options options = tankWith(16, {solidOf(Shape{Box{Vec3d(0.5, 0.5, -1.0), Vec3d(0.75, 0.75, 2.0)}})});
  const auto solid = Solids(options).at(0.0);
  FloatGrid::Ptr phi = makePhi(solid->voxelSize, 6.0 * solid->voxelSize);
  unite(
      *phi, [](const Vec3d& x) { return x[2] - 0.5; }, grown(solid->domain, 8));
  Frame frame;
  describeLiquid(frame, *phi, *solid);
  CHECK(frame.solidPhi == solid->phi);
  CHECK(frame.stats.cells == (16 * 16 - 4 * 4) * 8);
  CHECK(frame.stats.volume == Approx(0.5 * (1.0 - 0.0625)).epsilon(1e-4));
  REQUIRE(frame.surfacePhi);
  const double h = solid->voxelSize;
  CHECK((frame.surfacePhi->indexToWorld(Coord(0)) - Vec3d(0.5 * h)).length() < 1e-12);
  const auto phiAt = [&](int i, int j, int k) { return frame.surfacePhi->tree().getValue(Coord(i, j, k)); };
  CHECK(phiAt(4, 4, 7) == Approx(-0.5 * h).epsilon(1e-3));
  CHECK(phiAt(4, 4, 8) == Approx(0.5 * h).epsilon(1e-3));
  CHECK(phiAt(9, 9, 4) > 0.0f);  // in the block
  CHECK(phiAt(7, 9, 4) < 0.0f);
}
