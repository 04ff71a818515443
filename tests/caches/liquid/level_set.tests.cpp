#include "caches/liquid/level_set.h"

#include "tests/caches/liquid/surfaces.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <map>
#include <string>

using namespace fluidtex::caches;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

constexpr double kCell = 0.05;
const Ball kBall{Vec3d(0.51, -0.32, 1.03), 0.4};

SurfaceTriangles ballSurface(bool mirrored = false) {
  SurfaceTriangles surface = surfaceOfBall(kBall, 5);
  if (mirrored)
    for (Vec3I& t : surface.triangles) std::swap(t[0], t[1]);
  return surface;
}

// A square of side 1 in the plane z = 0.52.
SurfaceTriangles sheet() {
  SurfaceTriangles surface;
  for (const float y : {0.0f, 1.0f})
    for (const float x : {0.0f, 1.0f}) surface.points.emplace_back(x, y, 0.52f);
  surface.triangles = {Vec3I(0, 1, 3), Vec3I(0, 3, 2)};
  return surface;
}

// A place's value, or that of its tile.
double valueAt(const LevelSet& levelSet, const Vec3d& x) {
  return levelSet.phi->tree().getValue(openvdb::Coord::round(levelSet.phi->worldToIndex(x)));
}

bool sameBytes(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (a.activeVoxelCount() != b.activeVoxelCount() || a.tree().leafCount() != b.tree().leafCount())
    return false;
  for (auto leaf = a.tree().cbeginLeaf(); leaf; ++leaf) {
    const auto* other = b.tree().probeConstLeaf(leaf->origin());
    if (other == nullptr || leaf->getValueMask() != other->getValueMask() ||
        leaf->buffer() != other->buffer())
      return false;
  }
  return true;
}

std::vector<openvdb::FloatGrid::Ptr> continuedOff(const SurfaceTriangles& surface,
                                                  const std::vector<float>& values, int components,
                                                  int band) {
  ClosestTriangles closest(surface, kCell);
  return fluidtex::caches::continuedOff(closest, values, components, band);
}

}  // namespace

TEST_CASE("level_set: distances to a ball, however its triangles are turned", "[caches]") {
  for (const bool mirrored : {false, true}) {
    const LevelSet ball = levelSetOf(ballSurface(mirrored), kCell);
    CHECK_FALSE(ball.isSheet);
    CHECK(ball.phi->getGridClass() == openvdb::GRID_LEVEL_SET);
    CHECK(ball.phi->background() == Approx(kBand * kCell));
    double nearby = 0.0, farther = 0.0;
    for (auto value = ball.phi->cbeginValueOn(); value; ++value) {
      const double error = std::abs(*value - kBall.distance(ball.phi->indexToWorld(value.getCoord())));
      (std::abs(*value) < 1.5 * kCell ? nearby : farther) =
          std::max(std::abs(*value) < 1.5 * kCell ? nearby : farther, error);
    }
    CHECK(nearby < 0.05 * kCell);
    CHECK(farther < 0.05 * kCell);
    // The band is as wide as it should be, and what is behind it has its sign.
    const auto at = [&](const Vec3d& x) {
      return ball.phi->tree().getValue(openvdb::Coord::round(ball.phi->worldToIndex(x)));
    };
    CHECK(ball.phi->tree().isValueOn(openvdb::Coord::round(
        ball.phi->worldToIndex(kBall.center + Vec3d(kBall.radius + (kBand - 1) * kCell, 0, 0)))));
    CHECK(at(kBall.center) == Approx(-kBand * kCell));
    CHECK(at(kBall.center + Vec3d(5, 0, 0)) == Approx(kBand * kCell));
  }
}

TEST_CASE("level_set: cells have their centres where the solver's have", "[caches]") {
  CHECK(levelSetOf(ballSurface(), kCell).phi->indexToWorld(openvdb::Coord(0)) == Vec3d(0.5 * kCell));
  CHECK(levelSetOf({}, kCell).phi->indexToWorld(openvdb::Coord(0)) == Vec3d(0.5 * kCell));
}

TEST_CASE("level_set: a surface that encloses nothing is a sheet", "[caches]") {
  const LevelSet result = levelSetOf(sheet(), kCell);
  CHECK(result.isSheet);
  CHECK(result.phi->background() == Approx(kBand * kCell));
  double inside = 0.0;
  for (auto value = result.phi->cbeginValueOn(); value; ++value) {
    const Vec3d x = result.phi->indexToWorld(value.getCoord());
    if (x[0] < 0.3 || x[0] > 0.7 || x[1] < 0.3 || x[1] > 0.7 || std::abs(*value) > kCell) continue;
    CHECK(*value == Approx(std::abs(x[2] - 0.52) - 0.75 * kCell).margin(0.1 * kCell));
    inside += *value < 0.0f;
  }
  // Of one and a half cells' thickness one or two hold a centre.
  CHECK(inside / 64.0 == Approx(1.5).margin(0.51));
  CHECK(result.phi->tree().getValue(openvdb::Coord(10, 10, 60)) == Approx(kBand * kCell));
}

TEST_CASE("level_set: a closed surface beside a sheet stays what it is", "[caches]") {
  SurfaceTriangles surface = ballSurface();
  const auto offset = openvdb::Index32(surface.points.size());
  for (const Vec3f& x : sheet().points) surface.points.push_back(x + Vec3f(3, 0, 0));
  for (const Vec3I& t : sheet().triangles) surface.triangles.push_back(t + Vec3I(offset));
  const LevelSet result = levelSetOf(surface, kCell);
  CHECK_FALSE(result.isSheet);
  CHECK(result.phi->tree().getValue(openvdb::Coord::round(result.phi->worldToIndex(kBall.center))) < 0.0f);
}

TEST_CASE("level_set: without triangles there is no liquid", "[caches]") {
  const LevelSet result = levelSetOf({}, kCell);
  CHECK_FALSE(result.isSheet);
  CHECK(result.phi->activeVoxelCount() == 0);
  CHECK(result.phi->background() > 0.0f);
  CHECK(continuedOff({}, std::vector<float>{}, 3, 4).size() == 3);
}

TEST_CASE("level_set: triangles without area are no matter", "[caches]") {
  SurfaceTriangles surface = ballSurface();
  for (openvdb::Index32 n = 0; n < 50; ++n) surface.triangles.emplace_back(n, n, n + 1);
  const LevelSet result = levelSetOf(surface, kCell);
  CHECK_FALSE(result.isSheet);
  for (auto value = result.phi->cbeginValueOn(); value; ++value)
    if (std::abs(*value) < kCell)
      CHECK(*value ==
            Approx(kBall.distance(result.phi->indexToWorld(value.getCoord()))).margin(0.05 * kCell));
}

TEST_CASE("level_set: values are continued off the surface from its closest points", "[caches]") {
  const auto field = [](const Vec3d& x) { return 3.0 + x[0] - 2.0 * x[1] + 0.5 * x[2]; };
  const SurfaceTriangles surface = ballSurface();
  std::vector<float> values;
  for (const Vec3f& x : surface.points) values.insert(values.end(), {float(field(Vec3d(x))), x[2]});
  const std::vector<openvdb::FloatGrid::Ptr> grids = continuedOff(surface, values, 2, 4);
  REQUIRE(grids.size() == 2);
  double widest = 0.0, sum = 0.0;
  for (auto value = grids[0]->cbeginValueOn(); value; ++value) {
    const Vec3d x = grids[0]->indexToWorld(value.getCoord());
    const Vec3d closest = kBall.center + kBall.radius * (x - kBall.center).unit();
    const double error = std::max(std::abs(*value - field(closest)) / 2.3,
                                  std::abs(grids[1]->tree().getValue(value.getCoord()) - closest[2]));
    CHECK(error < 0.3 * kCell);
    sum += error;
    widest = std::max(widest, std::abs(kBall.distance(x)));
  }
  CHECK(grids[0]->activeVoxelCount() > 4000);
  CHECK(sum / double(grids[0]->activeVoxelCount()) < 0.05 * kCell);
  CHECK(widest > 3.5 * kCell);
  CHECK(widest < 5.0 * kCell);
}

TEST_CASE("level_set: values that are no numbers stay unknown", "[caches]") {
  const SurfaceTriangles surface = ballSurface();
  std::vector<float> values(surface.points.size(), 2.0f);
  values[0] = std::nanf("");
  const openvdb::FloatGrid::Ptr grid = continuedOff(surface, values, 1, 4).front();
  REQUIRE(grid->activeVoxelCount() > 4000);
  for (auto value = grid->cbeginValueOn(); value; ++value) CHECK(*value == Approx(2.0f));
}

TEST_CASE("level_set: distances are those to the closest of all triangles", "[caches]") {
  const double h = kCell;
  const Ball ball{Vec3d(0.31, 0.22, 0.4), 0.21}, other{Vec3d(0.52, 0.25, 0.38), 0.14};
  SurfaceTriangles withSlivers = surfaceOfBall(ball, 3);
  for (std::size_t n = 0; n < 120; ++n) {
    // A corner twice, and three corners on a line.
    const Vec3I t = withSlivers.triangles[n];
    withSlivers.triangles.emplace_back(t[0], t[0], t[1]);
    withSlivers.triangles.emplace_back(t[0], openvdb::Index32(withSlivers.points.size()), t[1]);
    withSlivers.points.push_back(0.5f * (withSlivers.points[t[0]] + withSlivers.points[t[1]]));
  }
  const std::map<std::string, SurfaceTriangles> surfaces{
      {"coarse ball", surfaceOfBall(ball, 2)},
      {"fine ball", surfaceOfBall(Ball{ball.center, 0.1}, 4)},
      {"soup of a ball", asSoup(surfaceOfBall(ball, 3))},
      {"box through cells' centres", surfaceOfBox(Vec3d(2.5 * h), Vec3d(10.5 * h, 8.5 * h, 6.5 * h))},
      {"two balls that overlap", joined(surfaceOfBall(ball, 3), surfaceOfBall(other, 3))},
      {"a quarter without area", withSlivers},
      {"far away", surfaceOfBall(Ball{Vec3d(1000.0, -2000.0, 1500.0), 0.2}, 3)},
      {"larger than cells", surfaceOfBox(Vec3d(-0.71, 0.03, 0.01), Vec3d(0.92, 1.33, 0.87))},
      {"triangles at random", randomTriangles(60, 0.4)},
      {"small triangles at random", randomTriangles(300, 0.03)},
  };
  for (const auto& [name, surface] : surfaces) {
    INFO(name);
    const LevelSetErrors errors = errorsOf(levelSetOf(surface, h), surface, h);
    CHECK(errors.nearby < 2e-3);
    CHECK(errors.tooNear < 2e-3);
    CHECK(errors.farther < (name.ends_with("random") ? 0.5 : 0.3));
    CHECK(errors.mean < 5e-3);
    CHECK(errors.missing == 0);
  }
}

TEST_CASE("level_set: inside is what cannot be reached", "[caches]") {
  const double h = kCell;
  SECTION("of a box whose sides go through the centres of cells") {
    const LevelSet box = levelSetOf(surfaceOfBox(Vec3d(0.5 * h), Vec3d(24.5 * h, 16.5 * h, 20.5 * h)), h);
    CHECK_FALSE(box.isSheet);
    for (int i = -8; i < 34; ++i)
      for (int j = -8; j < 26; ++j)
        for (int k = -8; k < 30; ++k) {
          const int out = std::max({-i, i - 24, -j, j - 16, -k, k - 20});
          const float value = box.phi->tree().getValue(openvdb::Coord(i, j, k));
          if (out < 0 && !(value < 0.0f)) FAIL("outside at " << openvdb::Coord(i, j, k));
          if (out > 0 && !(value > 0.0f)) FAIL("inside at " << openvdb::Coord(i, j, k));
          if (out == 0) CHECK(std::abs(value) < 1e-4 * h);
        }
  }
  SECTION("of balls that overlap it is both") {
    const Ball a{Vec3d(0.0), 0.5}, b{Vec3d(0.6, 0.1, 0.0), 0.4};
    const LevelSet both = levelSetOf(joined(surfaceOfBall(a, 4), surfaceOfBall(b, 4)), h);
    for (auto value = both.phi->cbeginValueAll(); value; ++value) {
      const Vec3d x = both.phi->indexToWorld(value.getCoord());
      const double distance = std::min(a.distance(x), b.distance(x));
      if (value.isVoxelValue() && std::abs(distance) > 0.1 * h) CHECK((*value < 0.0f) == (distance < 0.0));
    }
    CHECK(valueAt(both, a.center) < 0.0);
  }
  SECTION("a closed hollow too") {
    const LevelSet hollow =
        levelSetOf(joined(surfaceOfBall({Vec3d(0.0), 1.0}, 5), surfaceOfBall({Vec3d(0.0), 0.5}, 4)), h);
    CHECK(valueAt(hollow, Vec3d(0.0)) == Approx(-kBand * h));
    CHECK(valueAt(hollow, Vec3d(0.49, 0.0, 0.0)) < 0.0);
    CHECK(valueAt(hollow, Vec3d(1.05, 0.0, 0.0)) > 0.0);
  }
  SECTION("whichever way triangles are turned") {
    const SurfaceTriangles surface = surfaceOfBall(kBall, 4);
    SurfaceTriangles turned = surface;
    for (std::size_t n = 0; n < turned.triangles.size(); n += 3)
      std::swap(turned.triangles[n][1], turned.triangles[n][2]);
    const LevelSet a = levelSetOf(surface, h), b = levelSetOf(turned, h);
    for (auto value = a.phi->cbeginValueOn(); value; ++value)
      CHECK(b.phi->tree().getValue(value.getCoord()) == Approx(*value).margin(1e-5 * h));
    CHECK(a.phi->activeVoxelCount() == b.phi->activeVoxelCount());
  }
  SECTION("and not the gap between sides that are less than a cell apart") {
    const LevelSet boxes = levelSetOf(joined(surfaceOfBox(Vec3d(0.03), Vec3d(0.03 + 8 * h, 1.0, 1.0)),
                                             surfaceOfBox(Vec3d(0.03 + 8.7 * h, 0.03, 0.03), Vec3d(1.0))),
                                      h);
    // The gap is 0.7 cells wide. First no centre lies in it, then those of cells 8.
    for (int j = 2; j < 18; ++j) {
      CHECK(boxes.phi->tree().getValue(openvdb::Coord(7, j, 9)) < 0.0f);
      CHECK(boxes.phi->tree().getValue(openvdb::Coord(8, j, 9)) == Approx(-0.1 * h).margin(1e-3 * h));
      CHECK(boxes.phi->tree().getValue(openvdb::Coord(9, j, 9)) < 0.0f);
    }
    const double shift = 0.4 * h;
    const LevelSet moved =
        levelSetOf(joined(surfaceOfBox(Vec3d(0.03 - shift), Vec3d(0.03 - shift + 8 * h, 1.0, 1.0)),
                          surfaceOfBox(Vec3d(0.03 - shift + 8.7 * h, 0.03, 0.03), Vec3d(1.0))),
                   h);
    for (int j = 2; j < 18; ++j) {
      CHECK(moved.phi->tree().getValue(openvdb::Coord(7, j, 9)) < 0.0f);
      CHECK(moved.phi->tree().getValue(openvdb::Coord(8, j, 9)) > 0.0f);
      CHECK(moved.phi->tree().getValue(openvdb::Coord(9, j, 9)) < 0.0f);
    }
  }
  SECTION("of a thin plate nothing, and beside a ball it takes nothing from it") {
    const SurfaceTriangles plate = surfaceOfBox(Vec3d(0.0, 0.0, 0.512), Vec3d(1.0, 1.0, 0.512 + 0.2 * h));
    CHECK(levelSetOf(plate, h).isSheet);
    const Ball ball{Vec3d(0.5, 0.5, 0.9), 0.3};
    const LevelSet both = levelSetOf(joined(plate, surfaceOfBall(ball, 4)), h);
    CHECK_FALSE(both.isSheet);
    CHECK(valueAt(both, ball.center) < 0.0);
    for (auto value = both.phi->cbeginValueOn(); value; ++value)
      if (*value < 0.0f) CHECK(ball.distance(both.phi->indexToWorld(value.getCoord())) < 0.1 * h);
  }
  SECTION("and nothing where there is a way in") {
    for (const double slot : {0.0, 1.6}) {
      const double side = 40 * h;
      SurfaceTriangles box = surfaceOfBox(Vec3d(0.0), Vec3d(side));
      box.triangles.resize(10);  // all but the upper side
      const auto n = openvdb::Index32(box.points.size());
      for (const double x : {0.0, side - slot * h})
        for (const double y : {0.0, side}) box.points.emplace_back(x, y, side);
      box.triangles.emplace_back(n, n + 1, n + 3);
      box.triangles.emplace_back(n, n + 3, n + 2);
      const LevelSet result = levelSetOf(box, h);
      CHECK(result.isSheet == (slot > 0.0));
      CHECK((valueAt(result, Vec3d(0.5 * side)) < 0.0) == (slot == 0.0));
      CHECK(valueAt(result, Vec3d(0.5 * side)) == Approx(slot > 0.0 ? kBand * h : -kBand * h));
    }
  }
  SECTION("of a large ball all of it, without memory for it") {
    const Ball ball{Vec3d(0.3, 0.1, 0.2), 60 * h};
    const LevelSet large = levelSetOf(surfaceOfBall(ball, 6), h);
    double volume = 0.0;
    for (auto value = large.phi->cbeginValueAll(); value; ++value)
      if (*value < 0.0f) volume += double(value.getVoxelCount());
    CHECK(volume == Approx(4.0 / 3.0 * std::numbers::pi * 60 * 60 * 60).epsilon(2e-3));
    CHECK(large.phi->tree().leafCount() < 3000);
  }
  SECTION("also where it is cut by planes of cells, far from the origin") {
    for (const double place : {-3000.0, 0.0, 777.0}) {
      const Vec3d low(place, place + h * 3, -place);
      const LevelSet box = levelSetOf(surfaceOfBox(low, low + Vec3d(16 * h)), h);
      CHECK_FALSE(box.isSheet);
      CHECK(valueAt(box, low + Vec3d(8.3 * h)) < 0.0);
      CHECK(valueAt(box, low + Vec3d(-2 * h)) > 0.0);
    }
  }
}

TEST_CASE("level_set: triangles that are no numbers are left out", "[caches]") {
  SurfaceTriangles surface = surfaceOfBall(kBall, 4);
  const auto bad = openvdb::Index32(surface.points.size());
  surface.points.emplace_back(std::nanf(""), 0.0f, 0.0f);
  surface.points.emplace_back(0.0f, std::numeric_limits<float>::infinity(), 0.0f);
  surface.points.emplace_back(3e38f, 0.0f, 0.0f);
  for (openvdb::Index32 n = 0; n < 3; ++n) surface.triangles.emplace_back(n, n + 1, bad + n);
  const LevelSet result = levelSetOf(surface, kCell);
  CHECK(valueAt(result, kBall.center) < 0.0);
  CHECK(sameBytes(*result.phi, *levelSetOf(surfaceOfBall(kBall, 4), kCell).phi));
}

TEST_CASE("level_set: the same bytes on one thread and on several", "[caches]") {
  for (const SurfaceTriangles& surface :
       {surfaceOfBall({Vec3d(0.3), 1.5}, 6), randomTriangles(2000, 0.2), asSoup(surfaceOfBall(kBall, 4))}) {
    const LevelSet several = levelSetOf(surface, kCell);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(sameBytes(*several.phi, *levelSetOf(surface, kCell).phi));
  }
}

TEST_CASE("level_set: closest triangles of a level set go on to be those of its values", "[caches]") {
  const SurfaceTriangles surface = ballSurface();
  std::vector<float> values;
  for (const Vec3f& x : surface.points) values.push_back(x[0]);
  ClosestTriangles closest(surface, kCell);
  levelSetOf(closest);
  const auto after = continuedOff(closest, values, 1, 8), alone = continuedOff(surface, values, 1, 8);
  CHECK(after.front()->activeVoxelCount() == alone.front()->activeVoxelCount());
  for (auto value = after.front()->cbeginValueOn(); value; ++value) {
    const Vec3d x = after.front()->indexToWorld(value.getCoord());
    if (kBall.distance(x) > -4 * kCell)
      CHECK(*value ==
            Approx((kBall.center + kBall.radius * (x - kBall.center).unit())[0]).margin(0.3 * kCell));
  }
}
