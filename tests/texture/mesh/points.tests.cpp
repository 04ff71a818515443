#include "texture/mesh/points.h"

#include "tests/texture/levelset/level_sets.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

namespace {

float nearestOther(const PointSet& points, std::size_t i, float minCosine) {
  float best = 1e30f;
  for (std::size_t j = 0; j < points.position.size(); ++j) {
    if (j == i || points.normal[i].dot(points.normal[j]) < minCosine) continue;
    best = std::min(best, (points.position[i] - points.position[j]).length());
  }
  return best;
}

}  // namespace

TEST_CASE("points: fresh points keep their distance and leave no room for another") {
  const LevelSet phi(*sphereGrid(1.0, 0.1));
  const IsoSurface surface = isoSurface(phi);
  const PointSet points = spreadPoints(phi, surface, {}, 1.0f, 7);
  for (std::size_t i = 0; i < points.position.size(); ++i) CHECK(nearestOther(points, i, 0.0f) >= 0.8f);
  const double density = double(points.position.size()) / area(surface.positions, surface.triangles);
  CHECK(density > 0.7);
  CHECK(density < 1.2);
}

TEST_CASE("points: the key decides where fresh points are") {
  const LevelSet phi(*sphereGrid(1.0, 0.1));
  const IsoSurface surface = isoSurface(phi);
  const PointSet one = spreadPoints(phi, surface, {}, 1.0f, 1),
                 same = spreadPoints(phi, surface, {}, 1.0f, 1);
  CHECK(one.position == same.position);
  CHECK(spreadPoints(phi, surface, {}, 1.0f, 2).position != one.position);
}

TEST_CASE(
    "points: seeds come first, those on top of each other are thinned, those far away or not finite "
    "ignored") {
  const auto grid = sphereGrid(1.0, 0.1, Vec3d(0.0));
  const LevelSet phi(*grid);
  const IsoSurface surface = isoSurface(phi);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3f> seeds{{10.4f, 0, 0}, {10.3f, 0.1f, 0}, {0, 10, 0},
                                 {0, 0, 5},     {nan, 0, 0},      {1e30f, 0, 0}};
  const PointSet points = spreadPoints(phi, surface, seeds, 1.0f, 1);
  CHECK((points.position[0] - Vec3f(10, 0, 0)).length() < 0.02f);
  CHECK((points.position[1] - Vec3f(0, 10, 0)).length() < 0.02f);
  CHECK(points.normal[1].dot(Vec3f(0, 1, 0)) > 0.999f);
  CHECK((points.position[2] - Vec3f(0, 0, 10)).length() > 0.1f);
}

TEST_CASE("points: both sides of a thin sheet are covered") {
  const LevelSet phi(*boxGrid(Vec3d(1.0, 1.0, 0.06), 0.1));
  const PointSet points = spreadPoints(phi, isoSurface(phi), {}, 2.0f, 1);
  int above = 0, below = 0;
  for (const Vec3f& p : points.position) {
    if (std::abs(p.x()) > 8.0f || std::abs(p.y()) > 8.0f) continue;
    ++(p.z() > 0.0f ? above : below);
  }
  CHECK(above > 40);
  CHECK(below > 40);
}

TEST_CASE("points: fresh points lie on the smooth surface, however close they are to each other") {
  // At its edges the trilinear surface, on which they are thrown, is up to a fifth of a voxel from the smooth
  // one.
  const LevelSet phi(*boxGrid(Vec3d(0.62, 0.41, 0.33), 0.1));
  for (const float spacing : {0.1f, 1.0f}) {
    const PointSet points = spreadPoints(phi, isoSurface(phi), {}, spacing, 1);
    std::size_t off = 0;
    for (const Vec3f& p : points.position) off += std::abs(phi.sample(p).value) > 0.05f;
    INFO("spacing " << spacing << ", " << points.position.size() << " points");
    CHECK(off == 0);
  }
}
