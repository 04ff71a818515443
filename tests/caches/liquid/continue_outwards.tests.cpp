#include "caches/liquid/continue_outwards.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Vec3f;

TEST_CASE("continue outwards: layer by layer", "[caches]") {
  const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  for (auto at = openvdb::CoordBBox(Coord(0, 0, 0), Coord(5, 5, 0)).begin(); at; ++at)
    grid->tree().setValue(*at, Vec3f(1, 2, 3));
  grid->tree().setValue(Coord(20, 0, 0), Vec3f(2, 0, 0));
  grid->tree().setValue(Coord(22, 0, 0), Vec3f(4, 0, 0));
  continueOutwards(*grid, 2);
  for (const int k : {-2, -1, 1, 2}) CHECK(grid->tree().getValue(Coord(2, 2, k)) == Vec3f(1, 2, 3));
  CHECK_FALSE(grid->tree().isValueOn(Coord(2, 2, 3)));
  CHECK(grid->tree().getValue(Coord(21, 0, 0)) == Vec3f(3, 0, 0));  // the mean of both neighbours
  CHECK(grid->tree().getValue(Coord(19, 0, 0)) == Vec3f(2, 0, 0));
  CHECK(grid->tree().getValue(Coord(20, 0, 0)) == Vec3f(2, 0, 0));
}

TEST_CASE("continue outwards: a layer has the mean of the layers before, and nothing of its own",
          "[caches]") {
  const auto grid = openvdb::FloatGrid::create(-5.0f);
  grid->tree().setValue(Coord(0, 0, 0), 1.0f);
  grid->tree().setValue(Coord(2, 0, 0), 4.0f);
  continueOutwards(*grid, 0);
  CHECK(grid->activeVoxelCount() == 2);
  continueOutwards(*grid, 1);
  CHECK(grid->activeVoxelCount() == 2 + 11);
  CHECK(grid->tree().getValue(Coord(1, 0, 0)) == 2.5f);
  CHECK(grid->tree().getValue(Coord(0, 1, 0)) == 1.0f);
  CHECK_FALSE(grid->tree().isValueOn(Coord(1, 1, 0)));
  continueOutwards(*grid, 1);
  // Beside (1, 0, 0), (0, 1, 0) and (2, 1, 0).
  CHECK(grid->tree().getValue(Coord(1, 1, 0)) == Approx((2.5 + 1.0 + 4.0) / 3.0));
  CHECK(grid->tree().getValue(Coord(0, 2, 0)) == 1.0f);
  CHECK(grid->tree().getValue(Coord(0, 0, 0)) == 1.0f);
  // Two of one layer that lie side by side.
  const auto apart = openvdb::FloatGrid::create(-5.0f);
  apart->tree().setValue(Coord(0, 0, 0), 1.0f);
  apart->tree().setValue(Coord(3, 0, 0), 4.0f);
  continueOutwards(*apart, 1);
  CHECK(apart->tree().getValue(Coord(1, 0, 0)) == 1.0f);
  CHECK(apart->tree().getValue(Coord(2, 0, 0)) == 4.0f);
}

TEST_CASE("continue outwards: from tiles and over the sides of blocks", "[caches]") {
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->tree().addTile(1, Coord(0), 7.0f, true);
  continueOutwards(*grid, 2);
  // A block of 8 cells a side, two layers on each side, and where they meet around its edges one more row.
  CHECK(grid->activeVoxelCount() == 512 + 6 * 2 * 64 + 12 * 8);
  for (auto value = grid->cbeginValueOn(); value; ++value) CHECK(*value == 7.0f);
  CHECK(grid->tree().isValueOn(Coord(-2, 3, 3)));
  CHECK(grid->tree().isValueOn(Coord(8, 8, 3)));
  CHECK_FALSE(grid->tree().isValueOn(Coord(8, 8, 8)));
}
