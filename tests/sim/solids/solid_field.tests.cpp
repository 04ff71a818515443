#include "sim/solids/solid_field.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr int kCells = 16;
constexpr double kVoxel = 1.0 / kCells;

double sides(const Vec3d& x) {
  double nearest = kForever;
  for (int a = 0; a < 3; ++a) nearest = std::min({nearest, x[a], 1.0 - x[a]});
  return nearest;
}

double slab(const Vec3d& x) {
  return x[2] - 5.25 * kVoxel;
}

}  // namespace

TEST_CASE("solid field: distances at centres within the band, open shares of faces", "[sim]") {
  const CoordBBox domain = firstCells(Coord(kCells));
  const auto distance = [](const Vec3d& x) { return std::min(sides(x), slab(x)); };
  const SolidField field =
      makeSolidField(distance, distance, {}, domain, chunksIn(grown(domain, kSolidMargin)), kVoxel);
  CHECK(field.voxelSize == kVoxel);
  CHECK(field.domain == domain);
  CHECK(field.phiMirrored == field.phi);
  CHECK_FALSE(field.speed);
  CHECK_FALSE(field.visibility);
  for (int k = -2; k < 12; ++k) {
    const float expected = float(std::clamp((k + 0.5 - 5.25) * kVoxel, -3 * kVoxel, 3 * kVoxel));
    CAPTURE(k);
    CHECK(field.phi->tree().getValue(Coord(8, 8, k)) == Approx(expected).margin(1e-6));
  }
  CHECK(field.open[0].tree().getValue(Coord(8, 8, 4)) == 0.0f);
  CHECK(field.open[0].tree().getValue(Coord(8, 8, 5)) == Approx(0.75).margin(1e-5));
  CHECK(field.open[0].tree().getValue(Coord(8, 8, 6)) == 1.0f);
  CHECK(field.open[2].tree().getValue(Coord(8, 8, 5)) == 0.0f);
  CHECK(field.open[2].tree().getValue(Coord(8, 8, 6)) == 1.0f);
}

TEST_CASE("solid field: an open side is solid beyond, and its own faces are open", "[sim]") {
  const CoordBBox domain = firstCells(Coord(kCells));
  const auto closedSides = [](const Vec3d& x) { return std::min({x[1], 1.0 - x[1], x[2], 1.0 - x[2]}); };
  const SolidField field =
      makeSolidField(sides, closedSides, {}, domain, chunksIn(grown(domain, kSolidMargin)), kVoxel);
  CHECK(field.open[0].tree().getValue(Coord(0, 8, 8)) == 1.0f);
  CHECK(field.open[0].tree().getValue(Coord(kCells, 8, 8)) == 1.0f);
  CHECK(field.open[1].tree().getValue(Coord(8, 0, 8)) == 0.0f);
  CHECK(field.phi->tree().getValue(Coord(-1, 8, 8)) == Approx(-0.5 * kVoxel));
}
