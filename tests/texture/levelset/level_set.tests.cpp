#include "texture/levelset/level_set.h"

#include "tests/texture/levelset/level_sets.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fluidtex::texture;

TEST_CASE("level set: blocks hold the grid's values, in voxels, those at the surface first") {
  const double voxel = 0.25;
  const auto grid = sphereGrid(3.0, voxel);
  const LevelSet phi(*grid);
  REQUIRE(phi.surfaceBlockCount() > 0);
  CHECK(phi.blockCount() >= phi.surfaceBlockCount());
  for (std::size_t block = 0; block < phi.blockCount(); ++block) {
    const openvdb::Coord origin = phi.origin(block);
    CHECK(phi.find(origin) == block);
    bool crossed = false;
    const auto at = [&](int x, int y, int z) {
      return phi.values(block)[((x + 1) * kBlockPadded + y + 1) * kBlockPadded + z + 1];
    };
    for (int x = 0; x <= kBlockSide; ++x)
      for (int y = 0; y <= kBlockSide; ++y)
        for (int z = 0; z <= kBlockSide; ++z) {
          REQUIRE(at(x, y, z) ==
                  Approx(grid->tree().getValue(origin.offsetBy(x, y, z)) / voxel).margin(1e-5));
          crossed = crossed || (at(x, y, z) < 0.0f) != (at(0, 0, 0) < 0.0f);
        }
    if (block < phi.surfaceBlockCount()) CHECK(crossed);
  }
  CHECK(phi.find(openvdb::Coord(8000, 0, 0)) == kNone);
}

TEST_CASE("level set: value and gradient of a smooth distance, nothing where it is not known") {
  const LevelSet phi(*sphereGrid(8.0, 1.0, Vec3d(0.0)));
  for (const Vec3f& way : {Vec3f(1, 0, 0), Vec3f(0.6f, 0.0f, 0.8f), Vec3f(-1, 2, 3).unit()}) {
    const LevelSet::Sample s = phi.sample(way * 8.3f);
    REQUIRE(s.known);
    CHECK(s.value == Approx(0.3f).margin(0.01));
    CHECK((s.gradient - way).length() < 0.03f);
  }
  CHECK_FALSE(phi.sample(Vec3f(100.0f)).known);
}

TEST_CASE("level set: places come to the surface, no farther than they may") {
  const LevelSet phi(*sphereGrid(8.0, 1.0, Vec3d(0.0)));
  const Vec3f way = Vec3f(-1, 2, 3).unit();
  const LevelSet::Projection there = phi.project(way * 8.7f);
  REQUIRE(there.known);
  CHECK((there.position - way * 8.0f).length() < 0.01f);
  CHECK((there.normal - way).length() < 0.03f);
  CHECK(there.distance < 1e-3f);
  CHECK((phi.project(way * 9.0f, 0.25f).position - way * 9.0f).length() <= 0.2501f);
  CHECK((phi.slide(way * 8.1f).position - way * 8.0f).length() < 0.01f);
}

TEST_CASE("level set: tricubic samples are exact for quadratic polynomials, with their gradient") {
  // Catmull-Rom reproduces quadratics. The band of two voxels around the zero set is what samples see.
  const auto f = [](const Vec3d& p) {
    return 0.3 * p.x() - 0.8 * p.y() + 0.02 * p.z() * p.z() - 0.01 * p.x() * p.y();
  };
  openvdb::initialize();
  auto grid = FloatGrid::create(50.0f);
  const openvdb::CoordBBox box(openvdb::Coord(-12), openvdb::Coord(12));
  for (auto it = box.begin(); it; ++it) grid->tree().setValue(*it, float(f((*it).asVec3d())));
  const LevelSet phi(*grid);
  int known = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d p(4.0 * std::sin(1.7 * i), 1.5 * std::sin(0.9 * i + 1.0), 4.0 * std::cos(2.3 * i));
    if (std::abs(f(p)) > 1.0) continue;
    const LevelSet::Sample s = phi.sample(Vec3f(p));
    if (!s.known) continue;
    ++known;
    CHECK(s.value == Approx(f(p)).margin(1e-4));
    CHECK(s.gradient.x() == Approx(0.3 - 0.01 * p.y()).margin(1e-4));
    CHECK(s.gradient.y() == Approx(-0.8 - 0.01 * p.x()).margin(1e-4));
    CHECK(s.gradient.z() == Approx(0.04 * p.z()).margin(1e-4));
  }
  CHECK(known > 50);
}

TEST_CASE("level set: refuses values that are not finite, in leaves and tiles") {
  openvdb::initialize();
  auto leaf = sphereGrid(1.0, 0.1);
  leaf->tree().setValue(openvdb::Coord(10, 0, 0), std::numeric_limits<float>::quiet_NaN());
  CHECK_THROWS_AS(LevelSet(*leaf), std::invalid_argument);
  auto tile = FloatGrid::create(1.0f);
  tile->tree().addTile(1, openvdb::Coord(0), std::numeric_limits<float>::infinity(), false);
  CHECK_THROWS_AS(LevelSet(*tile), std::invalid_argument);
}

TEST_CASE("level set: voxels that are no cubes are refused") {
  const auto grid = sphereGrid(3.0, 0.5);
  auto flat = openvdb::math::Transform::createLinearTransform(0.5);
  flat->postScale(Vec3d(1.0, 1.0, 2.0));
  grid->setTransform(flat);
  CHECK_THROWS_AS(LevelSet(*grid), std::invalid_argument);
}

TEST_CASE("level set: the scale is 1 until it is set, then linear between voxels") {
  LevelSet phi(*sphereGrid(3.0, 0.5));
  CHECK_FALSE(phi.scaled());
  CHECK(phi.scale(Vec3f(6, 0, 0)) == 1.0f);
  constexpr int kSide = LevelSet::kScaled;
  std::vector<float> values;
  for (std::size_t block = 0; block < phi.blockCount(); ++block)
    for (int n = 0; n < kSide * kSide * kSide; ++n)
      values.push_back(10.0f + 0.5f * float(phi.origin(block).x() + n / (kSide * kSide)));
  phi.setScale(values);
  CHECK(phi.scaled());
  CHECK(phi.scale(Vec3f(5.25f, 0.5f, 0.5f)) == Approx(10.0f + 0.5f * 5.25f));
}
