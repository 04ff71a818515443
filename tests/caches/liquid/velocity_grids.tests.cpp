#include "caches/liquid/velocity_grids.h"

#include "caches/liquid/placement.h"
#include "tests/caches/liquid/flows.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3f;

namespace {

const Coord kLow(-9, -4, 2), kHigh(6, 11, 13);

Vec3d field(const Vec3d& x) {
  return Vec3d(1.0 + x[1] - 2.0 * x[2], 2.0 + x[0], x[0] - x[1] + 3.0 * x[2]);
}

// Values that tell where they come from.
openvdb::Vec3SGrid::Ptr marked(const openvdb::math::Transform::Ptr& transform) {
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setTransform(transform);
  for (auto at = openvdb::CoordBBox(kLow, kHigh).begin(); at; ++at)
    grid->tree().setValue(*at, Vec3f((*at).asVec3s() + Vec3f(0.5f, 100.25f, 200.125f)));
  return grid;
}

RawVelocity rawOf(const openvdb::Vec3SGrid::Ptr& vectors, bool onFaces, const Options& options = {}) {
  return {vectors, {}, onFaces, worldFromFile(options), velocityFromFile(options)};
}

// A surface where the grids of these tests lie, in cells of 0.1 m, and how far around it they are asked for.
const openvdb::FloatGrid& surface() {
  static const openvdb::FloatGrid::Ptr kSphere = [] {
    openvdb::initialize();
    const auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, Vec3f(0.0f), 0.1f);
    sphere->setTransform(sim::cellTransform(0.1));
    return sphere;
  }();
  return *kSphere;
}
constexpr double kAround = 1.0;

sim::FaceGrids faces(double h, int n, const std::function<Vec3d(const Vec3d&)>& flow) {
  sim::FaceGrids grids = sim::makeVelocity(h);
  for (int axis = 0; axis < 3; ++axis)
    for (auto at = openvdb::CoordBBox(Coord(-n), Coord(n)).begin(); at; ++at)
      grids.component[std::size_t(axis)]->tree().setValue(*at,
                                                          float(flow(grids[axis].indexToWorld(*at))[axis]));
  return grids;
}

}  // namespace

TEST_CASE("velocity_grids: grids of the world's axes are copied, each component in its place", "[caches]") {
  const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
  transform->postTranslate(Vec3d(3, -1, 0.5));
  Options options;
  options.unit = 0.5;
  options.move = Vec3d(0, 0, 7);
  options.velocityScale = 3.0;
  for (const bool onFaces : {false, true}) {
    const auto vectors = marked(transform);
    const sim::FaceGrids got = velocityGrids(rawOf(vectors, onFaces, options), surface(), kAround);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(got[axis].activeVoxelCount() == vectors->activeVoxelCount());
      std::size_t wrong = 0;
      for (auto value = vectors->cbeginValueOn(); value; ++value)
        wrong += got[axis].tree().getValue(value.getCoord()) != 1.5f * (*value)[axis];
      CHECK(wrong == 0);
      // The centre of voxel (0, 0, 0) lies at (1.5, -0.5, 0.25 + 7), a voxel is 0.125.
      Vec3d place(1.5, -0.5, 7.25);
      if (onFaces) place[axis] -= 0.5 * 0.125;
      CHECK((got[axis].indexToWorld(Coord(0)) - place).length() < 1e-12);
      CHECK((got[axis].voxelSize() - Vec3d(0.125)).length() < 1e-12);
    }
  }
}

TEST_CASE("velocity_grids: three grids of numbers, each where its own transform says", "[caches]") {
  RawVelocity raw = rawOf(nullptr, false);
  for (int axis = 0; axis < 3; ++axis) {
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    Vec3d shift(0.0);
    shift[axis] = -0.05;
    transform->postTranslate(shift);
    raw.numbers[std::size_t(axis)] = openvdb::FloatGrid::create(0.0f);
    raw.numbers[std::size_t(axis)]->setTransform(transform);
    raw.numbers[std::size_t(axis)]->tree().setValue(Coord(1, 2, 3), float(axis + 1));
  }
  const sim::FaceGrids got = velocityGrids(raw, surface(), kAround);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(got[axis].activeVoxelCount() == 1);
    CHECK(got[axis].tree().getValue(Coord(1, 2, 3)) == float(axis + 1));
    CHECK(got[axis].indexToWorld(Coord(0))[axis] == Approx(-0.05));
    CHECK(got[axis].indexToWorld(Coord(0))[(axis + 1) % 3] == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("velocity_grids: tiles have their values, those of 0 are left out", "[caches]") {
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->tree().addTile(1, Coord(0), Vec3f(1, 2, 0), true);
  grid->tree().addTile(1, Coord(8, 0, 0), Vec3f(0.0f), true);
  const sim::FaceGrids got = velocityGrids(rawOf(grid, false), surface(), kAround);
  CHECK(got[0].activeVoxelCount() == 512);
  CHECK(got[0].tree().getValue(Coord(7, 3, 1)) == 1.0f);
  CHECK(got[1].tree().getValue(Coord(0, 7, 7)) == 2.0f);
  CHECK(got[2].activeVoxelCount() == 0);
}

TEST_CASE("velocity_grids: turned grids give the vectors of the place, in the world's axes", "[caches]") {
  Options turn;
  turn.turn = Vec3d(20, 30, 40);
  turn.unit = 0.1;
  turn.move = Vec3d(0.1, 0.2, 0.3);
  Options up;
  up.up = UpAxis::y;
  up.unit = 0.001;
  for (const Options& options : {turn, up})
    for (const bool onFaces : {false, true}) {
      // A field of the world, in the file's axes, at the file's places.
      const Mat4d world = worldFromFile(options);
      const Mat3d fileFromWorld = velocityFromFile(options).inverse();
      const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
      grid->setTransform(openvdb::math::Transform::createLinearTransform(0.1 / options.unit));
      for (auto at = openvdb::CoordBBox(Coord(-16), Coord(16)).begin(); at; ++at) {
        Vec3d v;
        for (int axis = 0; axis < 3; ++axis) {
          Vec3d index = (*at).asVec3d();
          if (onFaces) index[axis] -= 0.5;
          v[axis] = fileFromWorld.transform(field(world.transform(grid->indexToWorld(index))))[axis];
        }
        grid->tree().setValue(*at, Vec3f(v));
      }
      const sim::FaceGrids got = velocityGrids(rawOf(grid, onFaces, options), surface(), kAround);
      double largest = 0.0;
      std::size_t count = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (auto value = got[axis].cbeginValueOn(); value; ++value) {
          const Vec3d x = got[axis].indexToWorld(value.getCoord());
          if (x.length() > 1.1) continue;  // beyond the file's grid only what is nearest is known
          largest = std::max(largest, std::abs(*value - field(x)[axis]));
          ++count;
        }
      CHECK(count > 10000);
      CHECK(largest < 1e-4);
    }
}

TEST_CASE("velocity_grids: mirrored and sheared grids are no copies", "[caches]") {
  Mat4d matrix = Mat4d::identity();
  matrix.setMat3(Mat3d(-0.1, 0.0, 0.0, 0.02, 0.1, 0.0, 0.0, 0.0, 0.1));
  const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setTransform(
      std::make_shared<openvdb::math::Transform>(std::make_shared<openvdb::math::AffineMap>(matrix)));
  for (auto at = openvdb::CoordBBox(Coord(-16), Coord(16)).begin(); at; ++at)
    grid->tree().setValue(*at, Vec3f(field(grid->indexToWorld(*at))));
  const sim::FaceGrids got = velocityGrids(rawOf(grid, false), surface(), kAround);
  CHECK(got[0].indexToWorld(Coord(0)) == Vec3d(0.05));
  for (int axis = 0; axis < 3; ++axis)
    CHECK(got[axis].tree().getValue(Coord(3, -2, 4)) == Approx(field(Vec3d(0.35, -0.15, 0.45))[axis]));
}

TEST_CASE("velocity_grids: from grids at the cells' centres", "[caches]") {
  std::vector<openvdb::FloatGrid::Ptr> components;
  for (int axis = 0; axis < 3; ++axis) {
    components.push_back(openvdb::FloatGrid::create(0.0f));
    components.back()->setTransform(sim::cellTransform(0.1));
    components.back()->tree().setValue(Coord(4, 5, 6), float(axis) - 1.5f);
  }
  const sim::FaceGrids got = velocityGrids(components);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(got[axis].tree().getValue(Coord(4, 5, 6)) == float(axis) - 1.5f);
    CHECK(got[axis].transform() == *sim::cellTransform(0.1));
  }
}

TEST_CASE("velocity_grids: leaves near a surface reach as far as is asked", "[caches]") {
  openvdb::initialize();
  const auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, Vec3f(0.0f), 0.1f);
  const sim::MaskTree::Ptr leaves = leavesNear(*sphere, 1.0);
  for (const double x : {1.0, 1.5, 2.1, 2.2}) CHECK(leaves->isValueOn(Coord::round(Vec3d(10.0 * x, 0, 0))));
  CHECK_FALSE(leaves->isValueOn(Coord(35, 0, 0)));
  CHECK(leavesNear(*openvdb::createLevelSet<openvdb::FloatGrid>(0.1, 3.0), 1.0)->empty());
}

TEST_CASE("velocity_grids: blended where both are known, else what is known", "[caches]") {
  sim::FaceGrids a = faces(0.1, 3, [](const Vec3d&) { return Vec3d(1, 2, 3); });
  sim::FaceGrids b = faces(0.1, 2, [](const Vec3d&) { return Vec3d(5, 2, -1); });
  b.component[0]->tree().setValue(Coord(20, 0, 0), 7.0f);
  const sim::FaceGrids got = blended(a, b, 0.25);
  CHECK(got[0].tree().getValue(Coord(1, 1, 1)) == Approx(2.0));
  CHECK(got[1].tree().getValue(Coord(1, 1, 1)) == Approx(2.0));
  CHECK(got[2].tree().getValue(Coord(1, 1, 1)) == Approx(2.0));
  CHECK(got[0].tree().getValue(Coord(3, 0, 0)) == 1.0f);
  CHECK(got[0].tree().getValue(Coord(20, 0, 0)) == 7.0f);
  CHECK(got[0].transform() == a[0].transform());
  CHECK(blended(a, b, 0.0).component[0] == a.component[0]);
  CHECK(blended(a, b, 1.0).component[0] == b.component[0]);
  CHECK(sameTransforms(a, b));
  CHECK_FALSE(sameTransforms(a, faces(0.2, 1, [](const Vec3d&) { return Vec3d(0.0); })));
}

TEST_CASE("velocity_grids: where a file's velocities lie", "[caches]") {
  const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
  Options options;
  options.up = UpAxis::y;
  options.unit = 2.0;
  const openvdb::BBoxd bounds = boundsOf(rawOf(marked(transform), true, options));
  CHECK(bounds.min().eq(Vec3d(-4.5, -6.5, -2.0), 1e-9));
  CHECK(bounds.max().eq(Vec3d(3.0, -1.0, 5.5), 1e-9));
  CHECK(boundsOf(rawOf(openvdb::Vec3SGrid::create(), false)).empty());
}
