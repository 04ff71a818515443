#include "caches/liquid/explained.h"

#include "caches/liquid/level_set.h"
#include "tests/caches/liquid/flows.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;
using openvdb::Vec3f;

namespace {

constexpr double kCell = 0.05, kSeconds = 1.0 / 24.0;
const Ball kBall{Vec3d(0.1, 0.2, 0.3), 0.4};

openvdb::FloatGrid::Ptr phiOf(const Ball& ball) {
  openvdb::initialize();
  const auto phi = openvdb::createLevelSet<openvdb::FloatGrid>(kCell, kBand);
  phi->setTransform(sim::cellTransform(kCell));
  const Coord middle = Coord::round(phi->worldToIndex(ball.center));
  const float band = float(kBand * kCell);
  for (auto at = openvdb::CoordBBox(middle.offsetBy(-15), middle.offsetBy(15)).begin(); at; ++at) {
    const float d = float(ball.distance(phi->indexToWorld(*at)));
    if (std::abs(d) < band)
      phi->tree().setValue(*at, d);
    else if (d < 0.0f)
      phi->tree().setValueOff(*at, -band);
  }
  return phi;
}

sim::FaceGrids facesOf(const Flow& flow, double t, double factor = 1.0) {
  sim::FaceGrids grids = sim::makeVelocity(kCell);
  for (int axis = 0; axis < 3; ++axis)
    for (auto at = openvdb::CoordBBox(Coord(-14), Coord(24)).begin(); at; ++at)
      grids.component[std::size_t(axis)]->tree().setValue(
          *at, float(factor * flow.velocity(grids[axis].indexToWorld(*at), t)[axis]));
  return grids;
}

Ball moved(const Flow& flow, double t) {
  return {flow.moved(kBall.center, t), kBall.radius};
}

}  // namespace

TEST_CASE("explained: points lie on the surface, spread over it, and are as few as is asked", "[caches]") {
  const std::vector<Vec3d> points = surfacePoints(*phiOf(kBall), 400);
  CHECK(points.size() > 300);
  CHECK(points.size() <= 401);
  Vec3d sum(0.0);
  for (const Vec3d& x : points) {
    CHECK(std::abs(kBall.distance(x)) < 0.06 * kCell);
    sum += (x - kBall.center) / kBall.radius;
  }
  CHECK(sum.length() / double(points.size()) < 0.1);
  CHECK(surfacePoints(*levelSetOf({}, kCell).phi, 100).empty());
}

TEST_CASE("explained: the weight is linear in time and has its mean", "[caches]") {
  for (const double mean : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    INFO(mean);
    double sum = 0.0;
    for (int n = 0; n < 100; ++n) {
      const double t = (n + 0.5) / 100.0, w = weightAt(mean, t);
      CHECK(w >= 0.0);
      CHECK(w <= 1.0);
      sum += w / 100.0;
      CHECK(weightAt(mean, 0.5) == Approx(0.5 * (weightAt(mean, 0.0) + weightAt(mean, 1.0))));
    }
    CHECK(sum == Approx(mean));
  }
}

TEST_CASE("explained: points move as the flow does", "[caches]") {
  const Flow turning = rotation(Vec3d(0.1, 0.2, 0.0), 6.0);  // a quarter of a radian in a frame
  const std::vector<Vec3d> points = surfacePoints(*phiOf(kBall), 200);
  const sim::FaceGrids grids = facesOf(turning, 0.0);
  const std::vector<Vec3d> steps = displacements(points, grids, grids, 0.5, kSeconds);
  for (std::size_t n = 0; n < points.size(); ++n)
    CHECK((points[n] + steps[n] - turning.moved(points[n], kSeconds)).length() < 0.01 * kCell);
  // Twice as fast at the end as at the begin: the mean is one and a half.
  const Flow steady = translation(Vec3d(1, 0, 0));
  for (const double weight : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const std::vector<Vec3d> mixed =
        displacements(points, facesOf(steady, 0.0), facesOf(steady, 0.0, 2.0), weight, kSeconds);
    CHECK(mixed[0][0] == Approx((1.0 + weight) * kSeconds));
  }
}

TEST_CASE("explained: exact velocities explain all, wrong ones less or nothing", "[caches]") {
  const Flow flow = translation(Vec3d(1.2, -0.9, 0.6));  // 1.3 cells in a frame
  const auto last = phiOf(kBall), phi = phiOf(moved(flow, kSeconds));
  const auto explained = [&](double factor) {
    const sim::FaceGrids grids = facesOf(flow, 0.0, factor);
    return bestMotion(*last, *phi, grids, grids, kSeconds).explained.value();
  };
  CHECK(explained(1.0) > 0.99);
  CHECK(explained(1.0) <= 1.0);
  CHECK(explained(0.5) == Approx(0.75).margin(0.03));  // half the distance is left, a quarter of its square
  CHECK(explained(0.0) == Approx(0.0).margin(1e-6));
  CHECK(explained(-1.0) < -1.0);
}

TEST_CASE("explained: the velocity that moved the frame is found", "[caches]") {
  const Flow flow = translation(Vec3d(1.2, -0.9, 0.6));
  const auto last = phiOf(kBall), phi = phiOf(moved(flow, kSeconds));
  const sim::FaceGrids right = facesOf(flow, 0.0), slow = facesOf(flow, 0.0, 0.4),
                       fast = facesOf(flow, 0.0, 1.6);
  CHECK(bestMotion(*last, *phi, right, slow, kSeconds).meanWeight == 0.0);
  CHECK(bestMotion(*last, *phi, slow, right, kSeconds).meanWeight == 1.0);
  CHECK(bestMotion(*last, *phi, slow, fast, kSeconds).meanWeight == 0.5);
  CHECK(bestMotion(*last, *phi, right, right, kSeconds).meanWeight == 0.5);
}

TEST_CASE("explained: the factor of velocities in another unit", "[caches]") {
  const Flow flow = translation(Vec3d(1.2, -0.9, 0.6));
  const auto last = phiOf(kBall), phi = phiOf(moved(flow, kSeconds));
  for (const double factor : {24.0, 1.0, 1.0 / 1.3, 0.01, 2.5, 100.0}) {
    INFO(factor);
    const sim::FaceGrids grids = facesOf(flow, 0.0, 1.0 / factor);
    const std::optional<VelocityFactor> found = bestFactor(*last, *phi, grids, grids, 0.5, kSeconds);
    REQUIRE(found);
    CHECK(found->factor == Approx(factor).epsilon(0.02));
    CHECK(found->residual < 0.05);
    CHECK(found->residualAtRest > 0.5);
    if (factor == 1.0) CHECK(found->residualAsIs < 0.05);
    if (factor == 24.0) CHECK(found->residualAsIs == Approx(found->residualAtRest).epsilon(0.1));
  }
}

TEST_CASE("explained: nothing can be told of what is at rest, or is not there", "[caches]") {
  const auto phi = phiOf(kBall), none = levelSetOf({}, kCell).phi;
  const sim::FaceGrids grids = facesOf(translation(Vec3d(1, 0, 0)), 0.0);
  CHECK_FALSE(bestMotion(*phi, *phi, grids, grids, kSeconds).explained);
  CHECK(bestMotion(*phi, *phi, grids, grids, kSeconds).meanWeight == 0.5);
  CHECK_FALSE(bestFactor(*phi, *phi, grids, grids, 0.5, kSeconds));
  CHECK_FALSE(bestMotion(*none, *phi, grids, grids, kSeconds).explained);
  CHECK_FALSE(bestFactor(*none, *none, grids, grids, 0.5, kSeconds));
}

TEST_CASE("explained: velocities beyond reason lead nowhere, and end", "[caches]") {
  const Flow flow = translation(Vec3d(1.2, -0.9, 0.6));
  const auto last = phiOf(kBall), phi = phiOf(moved(flow, kSeconds));
  const sim::FaceGrids grids = facesOf(flow, 0.0, 1e30);
  const FrameMotion motion = bestMotion(*last, *phi, grids, grids, kSeconds);
  REQUIRE(motion.explained);
  CHECK(*motion.explained <= 0.0);
  CHECK(std::isfinite(*motion.explained));
  CHECK(bestFactor(*last, *phi, grids, grids, 0.5, kSeconds));
}
