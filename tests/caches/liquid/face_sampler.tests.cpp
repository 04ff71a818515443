#include "caches/liquid/face_sampler.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using fluidtex::caches::FaceSampler;
using openvdb::Coord;
using openvdb::Vec3d;

namespace {

constexpr double kSide = 0.25;

Vec3d sampledFlow(const Vec3d& x) {
  return Vec3d(1.0 + x[1] - 2.0 * x[2], 2.0 + x[0], x[0] - x[1] + 3.0 * x[2]);
}

// On the faces of the cells from -4 to 4.
sim::FaceGrids sampledFaces() {
  sim::FaceGrids grids = sim::makeVelocity(kSide);
  for (int axis = 0; axis < 3; ++axis)
    for (auto at = openvdb::CoordBBox(Coord(-4), Coord(4)).begin(); at; ++at)
      grids.component[std::size_t(axis)]->tree().setValue(
          *at, float(sampledFlow(grids[axis].indexToWorld(*at))[axis]));
  return grids;
}

}  // namespace

TEST_CASE("face sampler: what is linear comes back, each component from its own faces", "[caches]") {
  const sim::FaceGrids grids = sampledFaces();
  const FaceSampler sampler(grids);
  for (const Vec3d& x : {Vec3d(0.0), Vec3d(0.1, -0.2, 0.33), Vec3d(-0.77, 0.5, 0.9), Vec3d(0.125)}) {
    Vec3d velocity;
    CHECK(sampler.at(x, velocity));
    CHECK((velocity - sampledFlow(x)).length() < 1e-5);
  }
}

TEST_CASE("face sampler: what is unknown is left out of the mean", "[caches]") {
  sim::FaceGrids grids = sim::makeVelocity(kSide);
  for (int axis = 0; axis < 3; ++axis) grids.component[std::size_t(axis)]->tree().setValue(Coord(0), 7.0f);
  grids.component[0]->tree().setValue(Coord(1, 0, 0), 3.0f);
  // A quarter of the way from the first of u to the second, and off both along y.
  const Vec3d x = grids[0].indexToWorld(Vec3d(0.25, 0.4, 0.0));
  Vec3d velocity;
  CHECK(FaceSampler(grids).at(x, velocity));
  CHECK((velocity - Vec3d(0.75 * 7.0 + 0.25 * 3.0, 7.0, 7.0)).length() < 1e-6);
}

TEST_CASE("face sampler: where nothing is known, zero", "[caches]") {
  sim::FaceGrids grids = sampledFaces();
  Vec3d velocity(9.0);
  CHECK_FALSE(FaceSampler(grids).at(Vec3d(10.0), velocity));
  CHECK(velocity == Vec3d(0.0));
  // One component alone that is not known.
  grids.component[1] = sim::makeVelocity(kSide).component[1];
  CHECK_FALSE(FaceSampler(grids).at(Vec3d(0.0), velocity));
  CHECK((velocity - Vec3d(1.0, 0.0, 0.0)).length() < 1e-5);
}
