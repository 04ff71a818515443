#include "sim/grid/dilate.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace fluidtex::sim;
using openvdb::Coord;
using openvdb::tools::dilateActiveValues;
using openvdb::tools::EXPAND_TILES;
using openvdb::tools::IGNORE_TILES;
using openvdb::tools::NN_FACE;

namespace {

// One cell at the upper corner of a block, so that its neighbours lie in other blocks.
const Coord kSeed(7, -1, 15);

int stepsFrom(const Coord& seed, const Coord& cell) {
  const Coord way = cell - seed;
  return std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]);
}

}  // namespace

TEST_CASE("dilate: a cell grows to all that are so many faces away, over the edges of blocks", "[sim]") {
  FloatTree phi(9.0f);
  phi.setValueOn(kSeed, -2.0f);
  MaskTree mask;
  mask.setValueOn(kSeed);
  dilateActiveValues(phi, 4, NN_FACE, IGNORE_TILES);
  dilateActiveValues(mask, 4, NN_FACE, IGNORE_TILES);
  // An octahedron of (2n + 1) (2n^2 + 2n + 3) / 3 cells.
  CHECK(phi.activeVoxelCount() == 129);
  CHECK(mask.activeVoxelCount() == 129);
  for (auto it = phi.cbeginValueOn(); it; ++it) REQUIRE(stepsFrom(kSeed, it.getCoord()) <= 4);
  for (auto it = mask.cbeginValueOn(); it; ++it) REQUIRE(stepsFrom(kSeed, it.getCoord()) <= 4);
}

TEST_CASE("dilate: what it adds keeps the value that was there", "[sim]") {
  FloatTree phi(9.0f);
  phi.setValueOn(kSeed, -2.0f);
  phi.setValueOff(kSeed.offsetBy(1, 0, 0), 5.0f);
  dilateActiveValues(phi, 1, NN_FACE, IGNORE_TILES);
  REQUIRE(phi.activeVoxelCount() == 7);
  CHECK(phi.getValue(kSeed) == -2.0f);
  CHECK(phi.isValueOn(kSeed.offsetBy(1, 0, 0)));
  CHECK(phi.getValue(kSeed.offsetBy(1, 0, 0)) == 5.0f);
  CHECK(phi.getValue(kSeed.offsetBy(-1, 0, 0)) == 9.0f);
}

TEST_CASE("dilate: a tile grows only where tiles are taken for their cells", "[sim]") {
  FloatTree tile(9.0f);
  tile.addTile(1, Coord(0), -3.0f, true);
  FloatTree expanded = tile;
  dilateActiveValues(tile, 1, NN_FACE, IGNORE_TILES);
  CHECK(tile.activeVoxelCount() == 512);
  dilateActiveValues(expanded, 1, NN_FACE, EXPAND_TILES);
  CHECK(expanded.activeVoxelCount() == 512 + 6 * 64);
}
