#include "sim/velocity/acceleration.h"

#include "sim/surface/level_set.h"
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

TEST_CASE("acceleration: what a turning body finds along its way adds up to nothing on it") {
  // A ball in two leaves and more that has come one and a half cells along x and turns about z.
  constexpr double kVoxel = 1.0 / 16.0, kTurn = 2.0, kTime = 0.05;
  Options options;
  options.resolution = 16;
  const Vec3d speed(1.5 * kVoxel / kTime, 0.0, 0.4), centre(0.55, 0.5, 0.5), before = centre - kTime * speed;
  const FloatGrid::Ptr phi = makePhi(kVoxel, 6.0 * kVoxel);
  unite(
      *phi, [&](const Vec3d& x) { return (x - centre).length() - 0.3; }, CoordBBox(Coord(0), Coord(15)));
  const auto turning = [&](const Vec3d& middle) {
    return velocityField(kVoxel, phi->constTree(), [&](const Vec3d& x) {
      const Vec3d r = x - middle;
      return speed + kTurn * Vec3d(-r[1], r[0], 0.0);
    });
  };
  const Velocity a = velocityField(kVoxel, phi->constTree(), [&](const Vec3d& x) {
    const Vec3d r = x - before;
    return -kTurn * kTurn * Vec3d(r[0], r[1], 0.0);
  });
  const auto bodies = [&](const std::vector<const FloatGrid*>& openings) {
    return bodiesOf(*phi, phi->constTree(), *Solids(options).at(0.0), openings);
  };
  const Bodies alone = bodies({});
  REQUIRE(alone.size() == 1);
  const auto change = meanChangeAlong(a, turning(before), turning(centre), alone, kTime);
  const double expected = kTurn * kTurn * kTime * speed[0];  // of its middle, which came against x
  CHECK(change[0][0] == Approx(expected).epsilon(0.01));
  CHECK(change[0][2] == Approx(0.0).margin(1e-6));
  CHECK(meanChangeAlong(a, turning(before), turning(centre), bodies({phi.get()}), kTime)[0] == Vec3d(0.0));

  Velocity u = makeVelocity(kVoxel, phi->constTree());
  add(u, a, alone, change, 0.5);
  const Coord inside(8, 8, 8), outside(8, 8, 15);
  CHECK(u[0].tree().getValue(inside) ==
        Approx(0.5 * (a[0].tree().getValue(inside) + change[0][0])).margin(1e-6));
  CHECK(u[0].tree().getValue(outside) == Approx(0.5 * a[0].tree().getValue(outside)).margin(1e-6));
}
