#include "sim/velocity/acceleration.h"

#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

FloatTree blockOfLeaves() {
  FloatTree topology(0.0f);
  for (int n = 0; n < 8; ++n)
    topology.touchLeaf(Coord(8 * (n >> 2), 8 * ((n >> 1) & 1), 8 * (n & 1)))->setValuesOn();
  return topology;
}

Velocity uniform(double value) {
  return velocityField(0.1, blockOfLeaves(), [=](const Vec3d&) { return Vec3d(value, 2.0 * value, -value); });
}

}  // namespace

TEST_CASE("acceleration: plus adds what acts for a time, and nothing where nothing is known", "[sim]") {
  const Velocity u = uniform(1.0), a = uniform(3.0);
  a.component[0]->tree().addTile(1, Coord(8, 8, 8), 0.0f, false);  // no values there
  const Velocity sum = plus(u, a, 0.5);
  CHECK(sum[0].tree().getValue(Coord(2, 3, 4)) == 2.5f);
  CHECK(sum[1].tree().getValue(Coord(2, 3, 4)) == 5.0f);
  CHECK(sum[2].tree().getValue(Coord(2, 3, 4)) == -2.5f);
  CHECK(sum[0].tree().getValue(Coord(9, 9, 9)) == 1.0f);
  CHECK(u[0].tree().getValue(Coord(2, 3, 4)) == 1.0f);
}

TEST_CASE("acceleration: is the change over the time where the projection knows, else 0", "[sim]") {
  FaceMasks valid;
  for (MaskGrid::Ptr& mask : valid.component) mask = MaskGrid::create();
  valid.component[0]->tree().setValueOn(Coord(1, 2, 3));
  valid.component[2]->tree().setValueOn(Coord(4, 4, 4));
  const Velocity a = accelerationBy(uniform(1.0), uniform(1.5), valid, 0.25);
  CHECK(a[0].tree().getValue(Coord(1, 2, 3)) == Approx(2.0f));
  CHECK(a[2].tree().getValue(Coord(4, 4, 4)) == Approx(-2.0f));
  CHECK(a[0].tree().getValue(Coord(4, 4, 4)) == 0.0f);
  CHECK(a[1].tree().getValue(Coord(1, 2, 3)) == 0.0f);
  CHECK(a[0].tree().activeVoxelCount() == 16 * 16 * 16);
}
