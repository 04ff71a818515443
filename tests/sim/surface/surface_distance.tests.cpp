#include "sim/surface/surface_distance.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr double kVoxel = 1.0 / 32;

// Every cell of a box set to `level`.
template <class Level>
FloatGrid::Ptr phiOf(const Level& level) {
  FloatGrid::Ptr phi = makePhi(kVoxel, 100.0);
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 32; ++j)
      for (int k = 0; k < 32; ++k)
        phi->tree().setValueOn(Coord(i, j, k), static_cast<float>(level(phi->indexToWorld(Coord(i, j, k)))));
  return phi;
}

}  // namespace

TEST_CASE("surface distance: a ball's, whatever the slopes of phi", "[sim]") {
  const auto ball = [](const Vec3d& x) { return (x - Vec3d(0.51, 0.5, 0.49)).length() - 0.3; };
  // The same zero set; slopes from 0.4 to 2.5.
  const FloatGrid::Ptr phi = phiOf(
      [&](const Vec3d& x) { return ball(x) * std::exp(0.9 * std::sin(5.0 * x[0]) * std::cos(4.0 * x[1])); });
  int found = 0, wanted = 0;
  double worst = 0.0;
  for (const FloatLeaf* leaf : leavesOf(phi->constTree())) {
    const auto cells = surfaceDistances(phi->constTree(), leaf->origin(), float(kVoxel), {});
    for (const CellDistance& cell : cells) {
      const Vec3d x = phi->indexToWorld(leaf->offsetToGlobalCoord(cell.offset));
      worst = std::max(worst, std::abs(cell.phi - ball(x) / kVoxel));
      ++found;
    }
    for (int n = 0; n < kLeafSize; ++n)
      wanted += std::abs(ball(phi->indexToWorld(leaf->offsetToGlobalCoord(n)))) < 1.0 * kVoxel;
  }
  CAPTURE(worst, found, wanted);
  CHECK(wanted > 1000);
  CHECK(found >= wanted);
  CHECK(worst < 0.01);
}

TEST_CASE("surface distance: cells that are not asked for, and far ones, are left out", "[sim]") {
  const FloatGrid::Ptr phi = phiOf([](const Vec3d& x) { return x[2] - 12.3 * kVoxel; });
  std::array<bool, kLeafSize> notAsked{};
  for (int n = 0; n < kLeafSize; ++n) notAsked[std::size_t(n)] = (n >> 6) < 4;
  int found = 0;
  for (const CellDistance& cell : surfaceDistances(phi->constTree(), Coord(8), float(kVoxel), notAsked)) {
    CHECK((cell.offset >> 6) >= 4);
    CHECK(cell.phi == Approx((8 + (cell.offset & 7)) + 0.5 - 12.3).margin(1e-3));
    ++found;
  }
  CHECK(found > 0);
  CHECK(surfaceDistances(phi->constTree(), Coord(8, 8, 24), float(kVoxel), {}).empty());
}
