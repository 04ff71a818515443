#include "caches/liquid/level_set.h"

#include "tests/caches/liquid/flows.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using openvdb::Vec3f;
using openvdb::Vec3I;

namespace {

constexpr double kCell = 0.05;
const Ball kBall{Vec3d(0.51, -0.32, 1.03), 0.4};

SurfaceTriangles ballSurface(bool mirrored = false) {
  std::vector<Vec3d> points;
  SurfaceTriangles surface;
  ballMesh(kBall, 5, points, surface.triangles);
  surface.points.assign(points.begin(), points.end());
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
    CHECK(farther < 0.5 * kCell);  // the library looks at few triangles there
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
  CHECK(continuedOff({}, {}, 3, kCell, 4).size() == 3);
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
  const std::vector<openvdb::FloatGrid::Ptr> grids = continuedOff(surface, values, 2, kCell, 4);
  REQUIRE(grids.size() == 2);
  double widest = 0.0, sum = 0.0;
  for (auto value = grids[0]->cbeginValueOn(); value; ++value) {
    const Vec3d x = grids[0]->indexToWorld(value.getCoord());
    const Vec3d closest = kBall.center + kBall.radius * (x - kBall.center).unit();
    const double error = std::max(std::abs(*value - field(closest)) / 2.3,
                                  std::abs(grids[1]->tree().getValue(value.getCoord()) - closest[2]));
    if (std::abs(kBall.distance(x)) < kCell) CHECK(error < 0.1 * kCell);
    sum += error;
    widest = std::max(widest, std::abs(kBall.distance(x)));
  }
  CHECK(grids[0]->activeVoxelCount() > 4000);
  // Far from the surface the library's closest triangle is one beside it at times.
  CHECK(sum / double(grids[0]->activeVoxelCount()) < 0.2 * kCell);
  CHECK(widest > 3.5 * kCell);
  CHECK(widest < 5.0 * kCell);
}

TEST_CASE("level_set: values that are no numbers stay unknown", "[caches]") {
  const SurfaceTriangles surface = ballSurface();
  std::vector<float> values(surface.points.size(), 2.0f);
  values[0] = std::nanf("");
  const openvdb::FloatGrid::Ptr grid = continuedOff(surface, values, 1, kCell, 4).front();
  REQUIRE(grid->activeVoxelCount() > 4000);
  for (auto value = grid->cbeginValueOn(); value; ++value) CHECK(*value == Approx(2.0f));
}
