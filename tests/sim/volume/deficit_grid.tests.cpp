#include "sim/volume/deficit_grid.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::sim;
using Catch::Matchers::WithinRel;

namespace {

constexpr int kCells = 16;
constexpr double kVoxel = 1.0 / kCells;

FloatGrid::Ptr emptyDeficit() {
  const auto deficit = FloatGrid::create(0.0f);
  deficit->setTransform(cellTransform(kVoxel));
  return deficit;
}

FloatGrid::Ptr ball(double radius) {
  const auto phi = makePhi(kVoxel, 6 * kVoxel);
  unite(
      *phi, [&](const Vec3d& x) { return (x - Vec3d(0.5)).length() - radius; }, firstCells(Coord(kCells)));
  return phi;
}

}  // namespace

TEST_CASE("deficit grid: it is given back over the time, by half a cell at once at most") {
  const auto deficit = FloatGrid::create(0.0f);
  deficit->tree().setValueOn(Coord(1, 2, 3), 0.1f);
  deficit->tree().setValueOn(Coord(1, 2, 4), -3.0f);
  const auto divergence = targetDivergence(*deficit, 0.25);
  CHECK(divergence->tree().getValue(Coord(1, 2, 3)) == Approx(0.4));
  CHECK(divergence->tree().getValue(Coord(1, 2, 4)) == Approx(-2.0));
}

TEST_CASE("deficit grid: a time that is not positive is refused", "[sim]") {
  for (const double time : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(targetDivergence(*emptyDeficit(), time), std::invalid_argument);
}

TEST_CASE("deficit grid: its total, and the cell where most is", "[sim]") {
  const auto deficit = emptyDeficit();
  CHECK(totalDeficit(*deficit) == 0.0);
  // The block at the origin has the larger total, the one beside it the largest cell.
  for (int n = 0; n < 8; ++n) deficit->tree().setValueOn(Coord(n, n, 1), -0.5f);
  deficit->tree().setValueOn(Coord(3, 2, 1), -0.75f);
  deficit->tree().setValueOn(Coord(9, 1, 1), 2.0f);
  CHECK_THAT(totalDeficit(*deficit), WithinRel(-2.75 * std::pow(kVoxel, 3), 1e-6));
  CHECK((placeOfLargest(*deficit) - kVoxel * Vec3d(3.5, 2.5, 1.5)).length() < 1e-6);
}

TEST_CASE("deficit grid: surface and deficit together stay what they are when phi is changed", "[sim]") {
  Options options;
  options.resolution = kCells;
  const SolidField solid = *Solids(options).at(0.0);
  const FloatGrid::Ptr before = ball(0.3), after = ball(0.26);
  const MaskGrid::Ptr where = MaskGrid::create();
  for (auto it = before->cbeginValueOn(); it; ++it) where->tree().setValueOn(it.getCoord());
  const auto deficit = emptyDeficit();
  addChange(*deficit, shownAround(*where, *before, solid), *after, solid);
  const double lost = liquidVolume(*before, solid) - liquidVolume(*after, solid);
  CHECK(lost > 0.03);
  CHECK_THAT(totalDeficit(*deficit), WithinRel(lost, 1e-4));
  addChange(*deficit, shownAround(*where, *after, solid), *before, solid);
  CHECK(std::abs(totalDeficit(*deficit)) < 1e-6 * lost);
}
