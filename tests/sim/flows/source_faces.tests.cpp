#include "sim/flows/source_faces.h"

#include "sim/flows/flows.h"
#include "sim/solids/solids.h"
#include "tests/sim/flows/flow_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

using namespace fluidtex::sim;

TEST_CASE("source faces: its back is closed, its sides and its front have its velocity") {
  Options options = channel();
  const double h = options.voxelSize();
  options.sources.resize(1);
  options.sources[0].shape.kind = Box{Vec3d(4.0, 3.0, 3.0) * h, Vec3d(8.0, 6.0, 5.0) * h};
  options.sources[0].velocity = Vec3d(2.0, 0.0, -1.0);
  const Flows flows(options);
  const SourceGrids& source = *flows.at(0.0).sources[0].source;
  const auto at = [&](int axis, int i, int j, int k) {
    return source.velocity[axis]->tree().getValue(Coord(i, j, k));
  };
  for (int k = 3; k < 5; ++k) {
    CHECK(at(0, 4, 4, k) == 0.0f);
    CHECK(at(0, 5, 4, k) == 2.0f);
    CHECK(at(0, 8, 4, k) == 2.0f);
    CHECK_FALSE(source.velocity[0]->tree().isValueOn(Coord(9, 4, k)));
  }
  CHECK(at(2, 6, 4, 5) == 0.0f);
  CHECK(at(2, 6, 4, 4) == -1.0f);
  CHECK(at(2, 6, 4, 3) == -1.0f);
  CHECK(at(1, 6, 3, 4) == 0.0f);
  CHECK(source.velocity[1]->tree().isValueOn(Coord(6, 6, 4)));
}

TEST_CASE("source faces: a sliver at a solid is the source's where it fills its open part") {
  // The floor is 3.6 cells high: in the cells whose centre it just covers 0.4 cells are open, with their
  // middle at 3.8.
  Options options = channel();
  const double h = options.voxelSize();
  options.solids.resize(1);
  options.solids[0].shape.kind = Box{Vec3d(-1.0), Vec3d(3.0, 3.0, 3.6 * h)};
  options.sources.resize(1);
  options.sources[0].velocity = Vec3d(1.0, 0.0, 0.0);
  for (const auto& [bottom, own] : {std::pair(3.4, true), std::pair(3.75, true), std::pair(3.85, false)}) {
    CAPTURE(bottom);
    options.sources[0].shape.kind = Box{Vec3d(4.0, 3.0, bottom) * h, Vec3d(8.0, 6.0, 7.0) * h};
    const Flows flows(options);
    const SourceGrids& source = *flows.at(0.0).sources[0].source;
    const auto solid = Solids(options).at(0.0);
    CHECK(isInSource(source, *solid, Coord(6, 4, 3)) == own);
    CHECK(isInSource(source, *solid, Coord(6, 4, 4)));
    CHECK_FALSE(isInSource(source, *solid, Coord(10, 4, 3)));
    CHECK_FALSE(isInSource(source, *solid, Coord(6, 4, 2)));
  }
}

TEST_CASE("source faces: a source within the water takes in nothing behind") {
  Options options = channel();
  options.cfl = 1.0;
  Source source;
  source.shape.kind = Box{Vec3d(0.5, 0.125, 0.125), Vec3d(0.75, 0.375, 0.25)};
  source.velocity = Vec3d(0.5, 0.0, 0.0);
  options.sources = {source};
  options.liquid = {box(Vec3d(-1.0), Vec3d(3.0, 1.0, 0.375))};
  Solver solver(options);
  const double first = solver.next().stats.volume;
  double last = first;
  for (int n = 2; n <= 13; ++n) last = solver.next().stats.volume;
  CHECK(std::abs((last - first) / (0.5 * 0.25 * 0.125 * 0.5) - 1.0) < 0.1);
}

TEST_CASE("source faces: a round source gives what its own front would, however it points") {
  // Its front is a staircase of cells, that of 2.6 cells' radius up to a sixth too large or too small.
  const double radius = 0.09, speed = 1.0;
  const auto [resolution, tolerance] = GENERATE(std::pair(29, 0.17), std::pair(58, 0.1));
  for (const Vec3d& way : {Vec3d(0.0, 0.0, -1.0), Vec3d(-0.7, -0.7, 0.2), Vec3d(0.6, 0.5, -0.6)}) {
    Options options;
    options.resolution = resolution;
    options.frameRate = 54.0;
    options.gravity = Vec3d(0.0);
    options.sources.resize(1);
    options.sources[0].shape = {Sphere{Vec3d(0.52, 0.51, 0.49), radius}};
    options.sources[0].velocity = speed * way.unit();
    Solver solver(options);
    constexpr int kFrames = 8;
    const double given = givenIn(solver, kFrames);
    CAPTURE(way, resolution);
    CHECK(given * 54.0 / kFrames == Catch::Detail::Approx(speed * M_PI * radius * radius).epsilon(tolerance));
  }
}

TEST_CASE("source faces: a source whose front ends in a wall gives nothing to the sliver before it") {
  // The walls stand less than half a cell behind the source's last cells on three sides, and its own front
  // lies in them.
  Options options = channel();
  const double h = options.voxelSize();
  const double end = GENERATE(0.03, 0.06, 0.3, 0.45);
  Solid walls;
  walls.shape.kind = Difference{{{Box{Vec3d(-1.0), Vec3d(3.0)}},
                                 {Box{Vec3d(3.3, 3.3, 3.3) * h, (Vec3d(20.0, 7.0, 7.0) + Vec3d(end)) * h}}}};
  options.solids = {walls};
  Source source;
  source.shape.kind = Box{Vec3d(14.2, 2.0, 2.0) * h, Vec3d(20.3 + end, 7.8, 7.8) * h};
  source.velocity = Vec3d(1.0, 0.6, 0.5);
  options.sources = {source};
  Solver solver(options);
  FrameStats stats;
  for (int n = 0; n < 5; ++n) {
    stats = solver.next().stats;
    CAPTURE(n, end);
    CHECK(largestDifference(solver.state(), 0.0) < 1.3);
    CHECK(std::abs(stats.deficit) < h * h * h);
  }
}
