#include "caches/liquid/particle_velocity.h"

#include "tests/caches/liquid/flows.h"
#include "tests/caches/liquid/particle_slabs.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <random>

using namespace fluidtex::caches;
using openvdb::Vec3f;

TEST_CASE("particle velocity: linear velocities come back, in the bulk and above a flat surface",
          "[caches]") {
  // A turn, a shear and a stretching at once.
  const auto field = [](const Vec3d& x) {
    return Vec3d(1.0 + 2.0 * x[1] - x[2], 2.0 - x[2] - 0.7 * x[0], 0.5 * x[0] + 0.3 * x[2]);
  };
  const std::vector<Vec3d> even = slab(0.1, 8);
  for (const std::vector<Vec3d>& points : {even, jittered(even, 0.1, 1.0)}) {
    std::vector<float> velocity;
    for (const Vec3d& x : points)
      for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(field(Vec3d(Vec3f(x)))[axis]));
    const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
    int inside = 0, above = 0;
    for (auto value = grid->cbeginValueOn(); value; ++value) {
      const Vec3d x = grid->indexToWorld(value.getCoord());
      // To 1.2 spacings above the uppermost: the surface is half a spacing above, and lies between voxels.
      if (std::abs(x[0] - 4.95) > 1.8 || std::abs(x[1] + 0.85) > 1.0 || x[2] < 1.0 || x[2] > 1.82) continue;
      const double error = (Vec3d(*value) - field(x)).length();
      INFO(x << ": " << error);
      CHECK(error < 1e-4 * field(x).length());
      ++(x[2] > 1.7 ? above : inside);
    }
    CHECK(inside > 3000);
    CHECK(above > 300);
  }
}

TEST_CASE("particle velocity: of one velocity all around", "[caches]") {
  const std::vector<Vec3d> points = slab(0.1, 4);
  std::vector<float> velocity;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (const float v : {0.3f, 0.0f, -0.41f}) velocity.push_back(v);
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  REQUIRE(grid->activeVoxelCount() > points.size());
  for (auto value = grid->cbeginValueOn(); value; ++value)
    CHECK((*value - Vec3f(0.3f, 0.0f, -0.41f)).length() < 1e-6f);
}

TEST_CASE("particle velocity: of jets that cross, with noise, nothing is faster than the fastest",
          "[caches]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec3f> points;
  std::vector<float> velocity;
  double fastest = 0.0;
  for (int n = 0; n < 12000; ++n) {
    // Threads of 3 spacings across along x and along y, and one of twenty a drop somewhere around.
    const double along = unit(random), a = 0.06 * unit(random), b = 0.06 * unit(random);
    const bool isDrop = n % 20 == 0;
    const Vec3d x = isDrop       ? Vec3d(unit(random), unit(random), 0.3 * unit(random))
                    : n % 2 == 0 ? Vec3d(along, a, b)
                                 : Vec3d(a, along, b + 0.03);
    const Vec3d v = (n % 2 == 0 ? Vec3d(5, 0, 0) : Vec3d(0, 4, 0)) +
                    Vec3d(unit(random), unit(random), unit(random)) * (isDrop ? 4.0 : 1.0);
    points.emplace_back(x);
    for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(v[axis]));
    fastest = std::max(fastest, v.length());
  }
  for (const double spacing : {0.02, 0.035, 0.06}) {
    const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(points, velocity, spacing);
    double most = 0.0;
    for (auto value = grid->cbeginValueOn(); value; ++value) most = std::max(most, double(value->length()));
    INFO(spacing << ": " << most << " of " << fastest);
    CHECK(most < 1.05 * fastest);
    CHECK(most > 4.0);
  }
}

TEST_CASE("particle velocity: a layer at a wall that keeps another velocity does not lead the liquid",
          "[caches]") {
  std::vector<float> velocity;
  const std::vector<Vec3d> points = jittered(slab(0.1, 8), 0.1, 0.6);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  for (const Vec3d& x : points)
    for (const double v : {x[2] < 1.05 ? 10.0 : 1.0, 0.0, 0.0}) velocity.push_back(float(v + noise(random)));
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  int count = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Vec3d x = grid->indexToWorld(value.getCoord());
    if (std::abs(x[0] - 4.95) > 1.5 || std::abs(x[1] + 0.85) > 0.8 || x[2] < 0.9 || x[2] > 1.9) continue;
    INFO(x << ": " << *value);
    CHECK((*value)[0] == Approx(1.0).margin(0.35));
    ++count;
  }
  CHECK(count > 1000);
}

TEST_CASE("particle velocity: a linear velocity field comes back, and beyond the outermost", "[caches]") {
  const auto field = [](const Vec3d& x) { return Vec3d(1.0 + x[1], 2.0 - x[2], 0.5 * x[0]); };
  const std::vector<Vec3d> points = latticeIn({Vec3d(0.3, 0.4, 0.5), 0.5}, 0.1);
  std::vector<float> velocity;
  for (const Vec3d& x : points)
    for (int axis = 0; axis < 3; ++axis) velocity.push_back(float(field(x)[axis]));
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles(floats(points), velocity, 0.1);
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    const Vec3d x = grid->indexToWorld(value.getCoord());
    const double error = (Vec3d(*value) - field(x)).length(), off = (x - Vec3d(0.3, 0.4, 0.5)).length() - 0.5;
    INFO(off << ": " << error);
    CHECK(error < (off < 0.05 ? 0.01 : 1.3 * off));
  }
  CHECK(grid->tree().isValueOn(openvdb::Coord(3 + 5 + 2, 4, 5)));
}

TEST_CASE("particle velocity: voxels around a particle and three layers beyond, none without particles",
          "[caches]") {
  const openvdb::Vec3SGrid::Ptr grid = velocityOfParticles({Vec3f(0.0f)}, {1, 2, 3}, 0.1);
  CHECK(grid->voxelSize().eq(Vec3d(0.1), 1e-12));
  // Three voxels along each axis, and as many layers.
  CHECK(grid->tree().isValueOn(openvdb::Coord(6, 0, 0)));
  CHECK(grid->tree().isValueOn(openvdb::Coord(3, 3, 6)));
  CHECK_FALSE(grid->tree().isValueOn(openvdb::Coord(7, 0, 0)));
  for (auto value = grid->cbeginValueOn(); value; ++value) CHECK((*value - Vec3f(1, 2, 3)).length() < 1e-6f);
  CHECK(velocityOfParticles({}, {}, 0.1)->activeVoxelCount() == 0);
  CHECK(velocityOfParticles({}, {}, 0.1)->voxelSize().eq(Vec3d(0.1), 1e-12));
}

TEST_CASE("particle velocity: the same on one thread and on several", "[caches]") {
  const std::vector<Vec3d> points = jittered(slab(0.1, 8), 0.1, 1.0);
  std::vector<float> velocity;
  for (const Vec3d& x : points)
    for (const double v : {std::sin(7.0 * x[0]), x[1] * x[2], std::cos(5.0 * x[1])})
      velocity.push_back(float(v));
  const openvdb::Vec3SGrid::Ptr several = velocityOfParticles(floats(points), velocity, 0.1);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const openvdb::Vec3SGrid::Ptr alone = velocityOfParticles(floats(points), velocity, 0.1);
  REQUIRE(alone->activeVoxelCount() == several->activeVoxelCount());
  for (auto value = alone->cbeginValueOn(); value; ++value)
    REQUIRE(several->tree().getValue(value.getCoord()) == *value);
}
