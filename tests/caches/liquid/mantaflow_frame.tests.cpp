#include "caches/liquid/mantaflow_frame.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Vec3f;

TEST_CASE("mantaflow_frame: nothing goes through the upper sides, and beyond them it goes on", "[caches]") {
  openvdb::initialize();
  const Coord resolution(6, 5, 4), last = resolution.offsetBy(-1);
  const auto made = [&] {
    const auto grid = openvdb::Vec3SGrid::create();
    for (auto at = openvdb::CoordBBox(Coord(0), last).begin(); at; ++at)
      grid->tree().setValue(*at, Vec3f(-1, -2, -3));
    return grid;
  };
  const auto closed = made();
  closeUpperSides(resolution, *closed);
  CHECK(closed->activeVoxelCount() == 7u * 6u * 5u);
  for (auto voxel = closed->cbeginValueOn(); voxel; ++voxel)
    for (int axis = 0; axis < 3; ++axis) {
      const bool inWall = voxel.getCoord()[axis] >= last[axis];
      CHECK((*voxel)[axis] == (inWall ? 0.0f : -1.0f - float(axis)));
    }

  // A side through which something flows out is no wall; nothing is added where nothing is known.
  const auto open = made();
  open->tree().setValue(Coord(5, 1, 1), Vec3f(0.5, -2, -3));
  open->tree().setValueOff(Coord(1, 4, 1), Vec3f(0));
  closeUpperSides(resolution, *open);
  CHECK(open->tree().getValue(Coord(5, 1, 1)) == Vec3f(0.5, -2, -3));
  CHECK(open->tree().getValue(Coord(5, 2, 2)) == Vec3f(-1, -2, -3));
  CHECK(open->tree().getValue(Coord(6, 2, 2)) == Vec3f(-1, -2, -3));
  CHECK(open->tree().getValue(Coord(2, 4, 2)) == Vec3f(-1, 0, -3));
  CHECK(open->tree().getValue(Coord(2, 5, 2)) == Vec3f(-1, 0, -3));
  CHECK_FALSE(open->tree().isValueOn(Coord(1, 4, 1)));
  CHECK_FALSE(open->tree().isValueOn(Coord(1, 5, 1)));
}
