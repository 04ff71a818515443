#include "sim/step/liquid_fields.h"

#include "sim/scalars/carried_scalar.h"
#include "sim/surface/level_set.h"
#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr double kVoxel = 1.0 / 16;

FloatGrid::Ptr ball() {
  FloatGrid::Ptr phi = makePhi(kVoxel, 6.0 * kVoxel);
  unite(
      *phi, [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.3; }, firstCells(Coord(16)));
  trimBand(*phi, *makePhi(kVoxel, 3.0 * kVoxel));
  return phi;
}

}  // namespace

TEST_CASE("liquid fields: velocity has faces wherever there is liquid or its band, all of them 0", "[sim]") {
  const auto solid = Solids(tankWith(16)).at(0.0);
  const FloatGrid::Ptr phi = ball();
  const Velocity velocity = velocityFor(*phi, *solid);
  CHECK(maxAbs(velocity) == 0.0);
  for (int a = 0; a < 3; ++a) {
    CHECK(velocity[a].tree().hasSameTopology(velocity[0].tree()));
    for (auto it = phi->cbeginValueOn(); it; ++it) REQUIRE(velocity[a].tree().isValueOn(it.getCoord()));
  }
}

TEST_CASE("liquid fields: gravity is added to every face along its own axis", "[sim]") {
  const auto solid = Solids(tankWith(16)).at(0.0);
  Liquid liquid;
  liquid.phi = ball();
  liquid.velocity = velocityFor(*liquid.phi, *solid);
  addGravity(liquid.velocity, Vec3d(0.25, 0.0, -0.5));
  addGravity(liquid.velocity, Vec3d(0.25, 0.0, -0.5));
  const float expected[3] = {0.5f, 0.0f, -1.0f};
  for (int a = 0; a < 3; ++a)
    for (auto it = liquid.velocity[a].cbeginValueOn(); it; ++it) REQUIRE(*it == expected[a]);
  CHECK(voxelSize(liquid) == Approx(kVoxel));
}

TEST_CASE("liquid fields: the cells of a source have its temperature, others their own", "[sim]") {
  const auto solid = Solids(tankWith(16)).at(0.0);
  const Velocity velocity = velocityFor(*ball(), *solid);
  const FloatGrid::Ptr temperature = makeScalar(*makeScalar(kVoxel, 300.0), velocity[0].tree());
  SourceGrids source;
  source.phi = makePhi(kVoxel, 6.0 * kVoxel);
  unite(
      *source.phi, [](const Vec3d& x) { return x[0] - 0.5; }, firstCells(Coord(16)));
  source.temperature = 900.0;
  RunningFlows flows;
  flows.sources.push_back({&source, 1.0});
  setInSources(*temperature, flows, &SourceGrids::temperature);
  CHECK(temperature->tree().getValue(Coord(7, 8, 8)) == 900.0f);
  CHECK(temperature->tree().getValue(Coord(9, 8, 8)) == 300.0f);
}
