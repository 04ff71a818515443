#include "sim/volume/volume_flux.h"

#include "tests/sim/volume/ball_and_flow.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fluidtex::sim;

namespace {

// The tank's cells and those around it.
LeafTable tankLeaves() {
  FloatTree topology(0.0f);
  for (int i = -8; i < kCells + 8; i += 8)
    for (int j = -8; j < kCells + 8; j += 8)
      for (int k = -8; k < kCells + 8; k += 8) topology.touchLeaf(Coord(i, j, k));
  return makeLeafTable(topology);
}

double amount(const std::vector<float>& shares, const std::vector<float>& room) {
  double sum = 0.0;
  for (std::size_t n = 0; n < shares.size(); ++n) sum += double(shares[n]) * room[n];
  return sum;
}

}  // namespace

TEST_CASE("volume flux: the room of a tank is its cells, without what solids take", "[sim]") {
  const LeafTable leaves = tankLeaves();
  const std::vector<float> room = openRoom(box(), leaves);
  for (std::size_t n = 0; n < room.size(); ++n)
    REQUIRE(room[n] == (firstCells(Coord(kCells)).isInside(leaves.coord(std::int64_t(n))) ? 1.0f : 0.0f));
}

TEST_CASE("volume flux: wet shares are the liquid's volume", "[sim]") {
  const SolidField solid = box();
  const LeafTable leaves = tankLeaves();
  const FloatGrid::Ptr phi = phiOf(ball);
  const std::vector<float> wet = wetShares(*phi, solid, leaves);
  CHECK(std::all_of(wet.begin(), wet.end(), [](float share) { return share >= 0.0f && share <= 1.0f; }));
  CHECK(amount(wet, openRoom(solid, leaves)) * std::pow(kVoxel, 3) ==
        Approx(liquidVolume(*phi, solid)).epsilon(1e-4));
}

TEST_CASE("volume flux: what is carried stays the same in sum", "[sim]") {
  const SolidField solid = box();
  const FloatGrid::Ptr phi = phiOf(ballAndFilm);
  const Velocity turning =
      flow([](const Vec3d& x) { return Vec3d(0.5 - x[1], x[0] - 0.5, std::sin(3.0 * x[0])); });
  const VolumeFlux flux = volumeFlux(tankLeaves(), *phi, *phi, turning, solid, 6.0 * kVoxel);
  CHECK(flux.steps > 1);
  const std::vector<float> before = wetShares(*phi, solid, flux.leaves);
  const CarriedShares after = carried(flux, before);
  CHECK(after.swept.empty());
  CHECK(amount(after.share, flux.room) == Approx(amount(before, flux.room)).epsilon(1e-5));
  CHECK(after.share != before);
}

TEST_CASE("volume flux: no flow moves nothing, and a source fills its cells", "[sim]") {
  const SolidField solid = box();
  const FloatGrid::Ptr phi = phiOf(ball);
  const Velocity still = flow([](const Vec3d&) { return Vec3d(0.0); });
  const VolumeFlux flux = volumeFlux(tankLeaves(), *phi, *phi, still, solid, 0.1);
  CHECK(flux.steps == 1);
  const std::vector<float> before = wetShares(*phi, solid, flux.leaves);
  CHECK(carried(flux, before).share == before);
  std::size_t dry = 0, full = 0;
  while (before[dry] != 0.0f || flux.room[dry] == 0.0f) ++dry;
  while (before[full] != 1.0f) ++full;
  const std::vector<float> filled = carried(flux, before, {{dry, 0.75f, true}, {full, 0.25f, true}}).share;
  CHECK(filled[dry] == Approx(0.75f));
  CHECK(filled[full] == 1.0f);  // at least as full as the source asks
  CHECK(carried(flux, before, {{full, 0.25f, false}}).share[full] == Approx(0.25f));
}
