#include "sim/surface/level_set.h"

#include "tests/sim/surface/surface_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;

TEST_CASE("level set: unite gives the shape's volume and signed tiles inside") {
  Surface f(1.0 / 64, Coord(64), ball(Vec3d(0.5), 0.3));
  CHECK(std::abs(f.volume() / (4.0 / 3.0 * std::numbers::pi * 0.027) - 1.0) < 2e-3);
  CHECK(f.phi->tree().getValue(Coord(32)) == -f.phi->background());
  CHECK(f.phi->tree().getValue(Coord(2)) == f.phi->background());
  unite(*f.phi, ball(Vec3d(0.5), 0.1), firstCells(f.cells));  // inside the first: nothing changes
  CHECK(std::abs(f.volume() / (4.0 / 3.0 * std::numbers::pi * 0.027) - 1.0) < 2e-3);
}

TEST_CASE("level set: the band is as wide as a step is long, and more", "[sim]") {
  for (const double cfl : {0.5, 1.0, 3.0}) CHECK(bandWidth(cfl) > cfl);
  CHECK(bandWidth(3.0) > bandWidth(0.5));
}

TEST_CASE("level set: solids are cut out of the liquid where asked, and nowhere else", "[sim]") {
  Surface f(1.0 / 32, Coord(32), ball(Vec3d(0.5), 0.3));
  FloatGrid::Ptr solid = makePhi(f.h, 3 * f.h);
  for (auto it = f.phi->cbeginValueOn(); it; ++it)
    solid->tree().setValueOn(it.getCoord(), static_cast<float>(f.phi->indexToWorld(it.getCoord()).z() - 0.5));
  const FloatGrid::Ptr before = f.phi->deepCopy();
  const MaskGrid::Ptr where = MaskGrid::create();
  where->tree().fill(openvdb::CoordBBox(Coord(0), Coord(15, 31, 31)), true, true);
  where->tree().voxelizeActiveTiles();
  cutSolids(*f.phi, *solid, *where);
  int cut = 0;
  for (auto it = before->cbeginValueOn(); it; ++it) {
    const Coord c = it.getCoord();
    const float all =
        std::clamp(std::max(*it, -solid->tree().getValue(c)), -f.phi->background(), f.phi->background());
    const float expected = c.x() < 16 ? all : *it;
    REQUIRE(f.phi->tree().getValue(c) == expected);
    cut += expected != *it;
  }
  CHECK(cut > 100);
}
