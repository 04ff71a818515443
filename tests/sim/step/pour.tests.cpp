#include "sim/step/pour.h"

#include "sim/step/liquid_fields.h"
#include "sim/surface/level_set.h"
#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex::sim;

namespace {

constexpr int kCells = 24;
constexpr double kVoxel = 1.0 / kCells;

Liquid nothing(const SolidField& solid) {
  Liquid liquid;
  liquid.phi = makePhi(kVoxel, 6.0 * kVoxel);
  liquid.velocity = velocityFor(*liquid.phi, solid);
  return liquid;
}

void pourBall(Liquid& liquid, const Vec3d& centre, const Vec3d& velocity, const SolidField& solid) {
  const ShapeDistance ball(Shape{Sphere{centre, 0.15}}, kVoxel);
  pour(liquid, ball, ball, LiquidBody{.shape = {}, .velocity = velocity}, solid);
}

}  // namespace

TEST_CASE("pour: a body comes with its velocity and leaves others theirs", "[sim]") {
  const auto solid = Solids(tankWith(kCells)).at(0.0);
  Liquid liquid = nothing(*solid);
  pourBall(liquid, Vec3d(0.25, 0.5, 0.5), Vec3d(1.0, 0.0, -2.0), *solid);
  pourBall(liquid, Vec3d(0.75, 0.5, 0.5), Vec3d(-3.0, 0.5, 0.0), *solid);
  const auto speedAt = [&](const Coord& c) {
    return Vec3d(liquid.velocity[0].tree().getValue(c), liquid.velocity[1].tree().getValue(c),
                 liquid.velocity[2].tree().getValue(c));
  };
  CHECK(speedAt(Coord(6, 12, 12)) == Vec3d(1.0, 0.0, -2.0));
  CHECK(speedAt(Coord(18, 12, 12)) == Vec3d(-3.0, 0.5, 0.0));
  CHECK(liquid.phi->tree().getValue(Coord(6, 12, 12)) < 0.0f);
  CHECK(liquid.phi->tree().getValue(Coord(12, 12, 12)) > 0.0f);
}

TEST_CASE("pour: what was poured is settled without changing a uniform fall", "[sim]") {
  const auto solid = Solids(tankWith(kCells)).at(0.0);
  Options options = tankWith(kCells);
  Liquid liquid = nothing(*solid);
  pourBall(liquid, Vec3d(0.5), Vec3d(0.0, 0.0, -1.0), *solid);
  const double kick = 0.01;
  REQUIRE(settle(liquid, *solid, kick, options));
  CHECK(liquid.leapfrogOffset == kick);
  CHECK_FALSE(liquid.markers.empty());
  const double expected = -1.0 + options.gravity[2] * kick;
  for (auto it = liquid.velocity[2].cbeginValueOn(); it; ++it)
    if (liquid.phi->tree().getValue(it.getCoord()) < -kVoxel) REQUIRE(*it == Approx(expected).epsilon(1e-4));
  CHECK(liquidVolume(*liquid.phi, *solid) ==
        Approx(4.0 / 3.0 * std::numbers::pi * std::pow(0.15, 3)).epsilon(0.03));
}

TEST_CASE("pour: where a solid was there is no liquid when it goes", "[sim]") {
  const auto with = Solids(tankWith(kCells, {solidOf(Shape{Sphere{Vec3d(0.5), 0.2}})})).at(0.0);
  const auto without = Solids(tankWith(kCells)).at(0.0);
  Liquid liquid = nothing(*without);
  unite(
      *liquid.phi, [](const Vec3d& x) { return x[2] - 0.8; }, grown(without->domain, 8));
  changeSolids(liquid, *with, *without);
  CHECK(liquid.phi->tree().getValue(Coord(12, 12, 12)) > 0.0f);
  CHECK(liquid.phi->tree().getValue(Coord(12, 12, 3)) < 0.0f);
  CHECK(liquidVolume(*liquid.phi, *without) ==
        Approx(0.8 - 4.0 / 3.0 * std::numbers::pi * 0.008).epsilon(0.01));
}
