#include "sim/grid/grids.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using openvdb::Coord;
using openvdb::CoordBBox;

TEST_CASE("grids: to OpenVDB's own grid and back keeps every value and state", "[sim]") {
  const auto grid = FloatGrid::create(3.0f);
  grid->setName("phi");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  // Tiles of every size, on and off, a block of one value, and scattered values on both sides of 0.
  grid->tree().sparseFill(CoordBBox(Coord(256), Coord(511)), -3.0f, false);
  grid->tree().sparseFill(CoordBBox(Coord(-64), Coord(-33)), 2.0f, true);
  grid->tree().sparseFill(CoordBBox(Coord(16), Coord(23)), -1.0f, true);
  grid->tree().touchLeaf(Coord(40));
  for (int n = 0; n < 500; ++n) {
    const Coord at((n * 37) % 300 - 100, (n * 91) % 200 - 60, (n * 53) % 150 - 70);
    grid->tree().setValue(at, 0.01f * static_cast<float>(n));
    if (n % 3 == 0) grid->tree().setValueOff(at);
  }

  const openvdb::FloatGrid::Ptr wide = toOpenVdb(*grid);
  const FloatGrid::Ptr back = fromOpenVdb(*wide);
  CHECK(wide->getName() == "phi");
  CHECK(back->getGridClass() == openvdb::GRID_LEVEL_SET);
  CHECK(back->voxelSize()[0] == 0.25);
  CHECK(wide->background() == 3.0f);
  CHECK(wide->tree().leafCount() == grid->tree().leafCount());
  CHECK(back->tree().hasSameTopology(grid->tree()));
  int wrong = 0;
  const auto same = [&](const Coord& at) {
    const float value = grid->tree().getValue(at);
    const bool on = grid->tree().isValueOn(at);
    wrong += wide->tree().getValue(at) != value || wide->tree().isValueOn(at) != on;
    wrong += back->tree().getValue(at) != value || back->tree().isValueOn(at) != on;
  };
  for (int i = -120; i < 540; i += 5)
    for (int j = -120; j < 540; j += 5)
      for (int k = -120; k < 540; k += 5) same(Coord(i, j, k));
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueAll(); value; ++value) same(value.getCoord());
  CHECK(wrong == 0);
}
