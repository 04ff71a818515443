#include "caches/liquid/fitted_velocity.h"

#include "caches/liquid/cached_flow.h"
#include "caches/liquid/face_sampler.h"
#include "tests/caches/liquid/cache_files.h"
#include "tests/scratch.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <functional>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

constexpr double kCell = 0.05, kSeconds = 0.1;

// A level set of five cells to either side.
openvdb::FloatGrid::Ptr levelSet(const std::function<double(const Vec3d&)>& distance) {
  openvdb::initialize();
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(kCell, 5.0);
  grid->setTransform(sim::cellTransform(kCell));
  for (auto c = openvdb::CoordBBox(openvdb::Coord(-24), openvdb::Coord(24)).begin(); c; ++c) {
    const double value = distance(grid->indexToWorld(*c)), width = 5.0 * kCell;
    if (std::abs(value) < width)
      grid->tree().setValue(*c, float(value));
    else
      grid->tree().setValueOff(*c, float(std::clamp(value, -width, width)));
  }
  return grid;
}

// Largest distance between the fitted velocity and `right` on points of a ball.
double farthest(const sim::FaceGrids& velocity, double radius,
                const std::function<Vec3d(const Vec3d&)>& right) {
  const FaceSampler sampler(velocity);
  double most = 0.0;
  for (int n = 0; n < 200; ++n) {
    const double z = -1.0 + (2 * n + 1) / 200.0, around = 2.4 * n, r = std::sqrt(1.0 - z * z);
    const Vec3d x = radius * Vec3d(r * std::cos(around), r * std::sin(around), z);
    Vec3d u;
    REQUIRE(sampler.at(x, u));
    most = std::max(most, (u - right(x)).length());
  }
  return most;
}

}  // namespace

TEST_CASE("fitted velocity: of a plane, the motion across it", "[caches]") {
  const Vec3d normal = Vec3d(1.0, 2.0, 2.0).unit();
  const auto fit = fittedVelocity(*levelSet([&](const Vec3d& x) { return x.dot(normal); }),
                                  *levelSet([&](const Vec3d& x) { return x.dot(normal) - 0.06; }), kSeconds);
  const FaceSampler sampler(fit);
  for (const Vec3d& x : {Vec3d(0.0), Vec3d(0.2, -0.1, 0.0), Vec3d(-0.3, 0.1, 0.05)}) {
    Vec3d u;
    REQUIRE(sampler.at(x, u));
    CHECK((u - 0.6 * normal).length() < 0.01);
  }
}

TEST_CASE("fitted velocity: of a ball that grows, and of a drop that moves as a whole", "[caches]") {
  const auto ball = [](double radius, const Vec3d& center) {
    return [=](const Vec3d& x) { return (x - center).length() - radius; };
  };
  const auto grown =
      fittedVelocity(*levelSet(ball(0.6, Vec3d(0.0))), *levelSet(ball(0.65, Vec3d(0.0))), kSeconds);
  CHECK(farthest(grown, 0.625, [](const Vec3d& x) { return 0.5 * x.unit(); }) < 0.03);
  // Two to three cells' radius: the sides, along which it moves, move with it.
  const Vec3d v(0.4, 0.0, 0.2);
  const auto moved = fittedVelocity(*levelSet(ball(0.12, -0.5 * kSeconds * v)),
                                    *levelSet(ball(0.12, 0.5 * kSeconds * v)), kSeconds);
  CHECK(farthest(moved, 0.12, [&](const Vec3d&) { return v; }) < 0.2 * v.length());
}

TEST_CASE("fitted velocity: a cache without velocities, only where that is asked for", "[caches]") {
  const Scratch scratch;
  const Clip clip{.flow = translation(Vec3d(0.5, 0.3, 0.0)), .ball = {}, .frames = 2};
  for (int frame = 1; frame <= 2; ++frame) {
    std::vector<Vec3d> points;
    std::vector<openvdb::Vec3I> triangles;
    ballMesh(clip.at(frame), 5, points, triangles);
    writeBytes(scratch.path / fmt::format("a_{}.ply", frame), plyBytes(points, triangles, {}));
  }
  Options options;
  options.path = scratch.path;
  const auto cache = [&] { return Cache{options, recognize(options), clip.h, clip.frameRate}; };
  CHECK_THROWS_WITH(CachedFlow(cache()), Catch::Contains("files.fit=true"));
  options.fit = true;
  CachedFlow flow(cache());
  flow.next();
  const sim::Frame second = flow.next();
  REQUIRE(second.substeps.size() == 1);
  CHECK_FALSE(second.stats.explained);
  REQUIRE(flow.warnings().size() == 1);
  CHECK(flow.warnings().front().find("there are no velocities") != std::string::npos);
  // What is carried lands on the surface of the second frame.
  sim::FaceGrids grids;
  grids.component = {second.substeps[0].u->deepCopy(), second.substeps[0].v->deepCopy(),
                     second.substeps[0].w->deepCopy()};
  const std::vector<Vec3d> points = surfacePoints(*readFrame(cache(), 1).phi, 500);
  const std::vector<Vec3d> moved = displacements(points, grids, grids, 0.5, 1.0 / clip.frameRate);
  double most = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n)
    most = std::max(most, std::abs(clip.at(2).distance(points[n] + moved[n])));
  CHECK(most < 0.1 * clip.h);
}
