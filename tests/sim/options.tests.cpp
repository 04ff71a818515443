#include "sim/options.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

DomainWall moving(DomainFace face, double speed) {
  DomainWall given;
  given.face = face;
  given.wall.kind = WallKind::noSlip;
  given.wall.velocity = Vec3d(speed, 0.0, 0.0);
  return given;
}

}  // namespace

TEST_CASE("options: nothing passes through walls and symmetry planes", "[sim]") {
  CHECK(isClosed(Side::wall));
  CHECK(isClosed(Side::symmetry));
  CHECK_FALSE(isClosed(Side::open));
  CHECK_FALSE(isClosed(Side::stream));
  CHECK_FALSE(isClosed(Side::unbounded));
}

TEST_CASE("options: a side of which nothing is said slips and stands", "[sim]") {
  Options options;
  options.walls = {moving(DomainFace::yHigh, 2.0)};
  for (const int side : {0, 1, 2, 4, 5}) {
    CHECK(options.wallOf(side).kind == WallKind::slip);
    CHECK(options.wallOf(side).velocity == Vec3d(0.0));
  }
  CHECK(options.wallOf(3).kind == WallKind::noSlip);
  CHECK(options.wallOf(3).velocity == Vec3d(2.0, 0.0, 0.0));
}

TEST_CASE("options: each face names the side of its place in the list of sides", "[sim]") {
  Options options;
  const DomainFace faces[] = {DomainFace::xLow,  DomainFace::xHigh, DomainFace::yLow,
                              DomainFace::yHigh, DomainFace::zLow,  DomainFace::zHigh};
  for (int n = 0; n < 6; ++n) options.walls.push_back(moving(faces[n], 1.0 + n));
  for (int side = 0; side < 6; ++side) CHECK(options.wallOf(side).velocity[0] == 1.0 + side);
}

TEST_CASE("options: of several walls for one face, the last counts, whether it names all or one", "[sim]") {
  Options options;
  options.walls = {moving(DomainFace::all, 1.0), moving(DomainFace::zLow, 2.0),
                   moving(DomainFace::zLow, 3.0)};
  CHECK(options.wallOf(4).velocity[0] == 3.0);
  CHECK(options.wallOf(5).velocity[0] == 1.0);
  options.walls.push_back(moving(DomainFace::all, 4.0));
  for (int side = 0; side < 6; ++side) CHECK(options.wallOf(side).velocity[0] == 4.0);
}

TEST_CASE("options: cells are the longest side over the resolution", "[sim]") {
  Options options;
  options.resolution = 40;
  for (int axis = 0; axis < 3; ++axis) {
    options.size = Vec3d(0.5, 0.25, 0.75);
    options.size[axis] = 2.0;
    CHECK(options.voxelSize() == 0.05);
  }
}
