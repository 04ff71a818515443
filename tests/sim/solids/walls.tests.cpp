#include "sim/solids/walls.h"

#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

// A tank with a floor like this.
SolidField tankWithFloor(const Wall& wall) {
  Options options = tankWith(16);
  options.walls = {{DomainFace::zLow, wall}};
  return *Solids(options).at(0.0);
}

}  // namespace

TEST_CASE("walls: slip lengths from no slip to free slip", "[sim]") {
  CHECK(slipLength({WallKind::noSlip, 0.3}) == 0.0);
  CHECK(slipLength({WallKind::friction, 0.3}) == 0.3);
  CHECK(slipLength({WallKind::slip, 0.3}) == kForever);
  CHECK_FALSE(grips({WallKind::slip}));
  CHECK(grips({WallKind::noSlip}));
  CHECK(grips({WallKind::friction}));
}

TEST_CASE("walls: each cell has its nearest wall's slip length, and the wall's velocity along itself",
          "[sim]") {
  CHECK_FALSE(tankWithFloor({WallKind::slip}).slipLength);
  const SolidField solid = tankWithFloor({WallKind::friction, 0.25, Vec3d(2.0, 0.0, 5.0)});
  REQUIRE(solid.slipLength);
  CHECK(solid.slipLength->tree().getValue(Coord(8, 8, 0)) == 0.25f);
  CHECK(solid.slipLength->tree().getValue(Coord(8, 8, 15)) == std::numeric_limits<float>::infinity());
  REQUIRE(solid.slide.component[0]);
  CHECK(solid.slide[0].tree().getValue(Coord(8, 8, 0)) == Approx(2.0));
  // What points out of the wall is left out.
  if (solid.slide.component[2]) CHECK(std::abs(solid.slide[2].tree().getValue(Coord(8, 8, 0))) < 1e-6f);
}

TEST_CASE("walls: the velocity goes linearly through the wall's at the surface", "[sim]") {
  for (const double slip : {0.0, 0.1}) {
    const SolidField solid =
        tankWithFloor(slip == 0.0 ? Wall{WallKind::noSlip} : Wall{WallKind::friction, slip});
    const double h = solid.voxelSize;
    // Shear flow that is 0 at the depth of the slip length behind the floor.
    Velocity velocity = makeVelocity(h);
    FaceMasks valid{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};
    for (int i = -4; i < 20; ++i)
      for (int j = -4; j < 20; ++j)
        for (int k = -4; k < 20; ++k)
          for (int a = 0; a < 3; ++a) {
            const Coord c(i, j, k);
            velocity.component[a]->tree().setValueOn(
                c, a == 0 ? float((std::max(k, 0) + 0.5) * h + slip) : 0.0f);
            if (k >= 0) valid.component[a]->tree().setValueOn(c);
          }
    stickToWalls(velocity, solid, valid);
    CHECK(velocity[0].tree().getValue(Coord(8, 8, 0)) == Approx(0.5 * h + slip));
    CHECK(velocity[0].tree().getValue(Coord(8, 8, -1)) == Approx(-0.5 * h + slip).margin(1e-6));
  }
}
