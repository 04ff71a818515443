#include "sim/surface/mirror_sides.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <random>

using namespace fluidtex::sim;

TEST_CASE("mirror sides: beyond a symmetry side each cell is its mirror image, elsewhere what it was",
          "[sim]") {
  Options options;
  options.resolution = 12;  // the upper side lies within a block
  options.sides.fill(Side::wall);
  options.sides[0] = options.sides[3] = Side::symmetry;  // low x, high y
  const SolidField solid = *Solids(options).at(0.0);
  FloatGrid::Ptr phi = makePhi(options.voxelSize(), 1.0);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  for (int i = -8; i < 16; ++i)
    for (int j = -8; j < 16; ++j)
      for (int k = -8; k < 16; ++k) phi->tree().setValueOn(Coord(i, j, k), value(random));
  const FloatGrid::Ptr before = phi->deepCopy();
  mirrorAtSides(*phi, solid);
  for (auto it = phi->cbeginValueOn(); it; ++it) {
    Coord inside = it.getCoord();
    if (inside[0] < 0) inside[0] = -1 - inside[0];
    if (inside[1] > 11) inside[1] = 23 - inside[1];
    REQUIRE(*it == before->tree().getValue(inside));
  }
}
