#include "sim/shapes/pose.h"

#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace fluidtex::sim;

TEST_CASE("pose: a mesh sequence goes evenly from file to file and rests outside of them") {
  MeshSequence sequence;
  sequence.first = 3;
  sequence.last = 33;
  sequence.frameRate = 30.0;
  sequence.start = 0.7;
  const Solid solid = solidOf(sequence);
  CHECK_FALSE(poseAt(solid, 0.699).moving());
  CHECK(poseAt(solid, 0.699).file == 0);
  CHECK_FALSE(poseAt(solid, 1.71).moving());
  CHECK(poseAt(solid, 1.71).file == 30);
  CHECK(poseAt(solid, 1.71).part == 0.0);
  // At a file's time it goes on as after it, whatever rounding does.
  for (int n = 0; n < 30; ++n) {
    const Pose pose = poseAt(solid, sequence.timeOf(n));
    CHECK(pose.file == n);
    CHECK(pose.part == 0.0);
    CHECK(pose.fileRate == 30.0);
  }
  CHECK_FALSE(poseAt(solid, sequence.timeOf(30)).moving());
  const Pose between = poseAt(solid, 0.7 + 4.25 / 30.0);
  CHECK(between.file == 4);
  CHECK(between.part == Approx(0.25));
}

TEST_CASE("pose: a solid moves evenly between keyframes and rests outside of them") {
  Solid solid;
  solid.pivot = Vec3d(1.0, 0.0, 0.0);
  solid.axis = Vec3d(0.0, 0.0, 2.0);
  solid.keyframes = {{1.0, Vec3d(0.0), 0.0}, {3.0, Vec3d(0.0, 0.0, 1.0), 720.0}};
  const double degrees = std::numbers::pi / 180.0;
  CHECK_FALSE(poseAt(solid, 0.5).moving());
  CHECK(poseAt(solid, 0.5).toWorld(Vec3d(2.0, 0.0, 0.0)) == Vec3d(2.0, 0.0, 0.0));
  CHECK(poseAt(solid, 1.0).moving());
  CHECK_FALSE(poseAt(solid, 3.0).moving());
  // A quarter turn after a quarter of a second, an eighth of the way up.
  const Pose pose = poseAt(solid, 1.25);
  CHECK(pose.angle == Approx(90.0 * degrees));
  const Vec3d x = pose.toWorld(Vec3d(2.0, 0.0, 0.0));
  CHECK((x - Vec3d(1.0, 1.0, 0.125)).length() < 1e-12);
  CHECK((pose.toBody(x) - Vec3d(2.0, 0.0, 0.0)).length() < 1e-12);
  // The velocity is the rate of change of the place.
  const Vec3d after = poseAt(solid, 1.25 + 1e-6).toWorld(Vec3d(2.0, 0.0, 0.0));
  CHECK(((after - x) / 1e-6 - pose.velocityAt(x)).length() < 1e-4);
}

TEST_CASE("pose: bounds are those of the turned and moved box, infinite where that is", "[sim]") {
  Pose pose;
  pose.pivot = Vec3d(1.0, 0.0, 0.0);
  pose.angle = 0.25 * std::numbers::pi;
  pose.move = Vec3d(0.0, 0.0, 5.0);
  const openvdb::BBoxd bounds = boundsAt({Vec3d(0.0, -1.0, 0.0), Vec3d(2.0, 1.0, 1.0)}, pose);
  const double halfDiagonal = std::numbers::sqrt2;
  CHECK((bounds.min() - Vec3d(1.0 - halfDiagonal, -halfDiagonal, 5.0)).length() < 1e-9);
  CHECK((bounds.max() - Vec3d(1.0 + halfDiagonal, halfDiagonal, 6.0)).length() < 1e-9);
  CHECK(boundsAt({Vec3d(0.0, 0.0, -kForever), Vec3d(1.0)}, pose).min().z() == -kForever);
  CHECK((pose.directionToWorld(Vec3d(1.0, 0.0, 0.0)) - Vec3d(0.5 * halfDiagonal, 0.5 * halfDiagonal, 0.0))
            .length() < 1e-12);
}

TEST_CASE("pose: what gets into a box is what its inverse motion sweeps", "[sim]") {
  Solid solid;
  solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(-3.0, 0.0, 0.0), 0.0}};
  const openvdb::BBoxd reach = reachOf(solid, {Vec3d(0.0), Vec3d(1.0)});
  for (const double x : {0.01, 0.99, 2.0, 3.99}) CHECK(reach.isInside(Vec3d(x, 0.5, 0.5)));
  CHECK_FALSE(reach.isInside(Vec3d(-0.5, 0.5, 0.5)));
  CHECK_FALSE(reach.isInside(Vec3d(0.5, 1.5, 0.5)));
}
