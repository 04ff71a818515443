#include "caches/liquid/cached_flow.h"

#include "caches/liquid/survey.h"
#include "tests/caches/liquid/cache_files.h"
#include "transport/backtrace.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Vec3f;

namespace {

// Mean distance between the surface and the ball's, cells.
double surfaceError(const openvdb::FloatGrid& phi, const Ball& ball) {
  const double h = phi.voxelSize()[0];
  double sum = 0.0;
  int count = 0;
  for (auto value = phi.cbeginValueOn(); value; ++value) {
    if (std::abs(*value) > h) continue;
    sum += std::abs(double(*value) - ball.distance(phi.indexToWorld(value.getCoord())));
    ++count;
  }
  REQUIRE(count > 100);
  return sum / count / h;
}

std::vector<Vec3f> pointsOn(const Ball& ball) {
  std::vector<Vec3d> points;
  std::vector<openvdb::Vec3I> triangles;
  ballMesh(ball, 2, points, triangles);
  return {points.begin(), points.end()};
}

// Largest distance of points of the first frame's surface, carried through all frames, from where they are to
// be, cells.
double carriedError(const std::vector<sim::Frame>& frames, const Clip& clip) {
  const std::vector<Vec3f> first = pointsOn(clip.ball);
  std::vector<Vec3f> carried = first;
  for (const sim::Frame& frame : frames) carried = transport::traceForward(carried, frame);
  double largest = 0.0;
  for (std::size_t n = 0; n < first.size(); ++n)
    largest =
        std::max(largest, (clip.flow.moved(Vec3d(first[n]), clip.time(clip.frames)) - carried[n]).length());
  return largest / clip.h;
}

// A ball that goes once round in 96 frames is where it was, and the velocity carries its points with it.
void checkTurn(Way way) {
  INFO(nameOf(way));
  Clip clip;
  clip.flow = rotation(Vec3d(0.5), std::numbers::pi / 2.0);
  clip.ball = {Vec3d(0.5, 0.25, 0.5), 0.2};
  clip.frames = 97;
  const Scratch scratch;
  const CacheFiles files = writeCache(way, clip, scratch.path);
  const std::vector<sim::Frame> frames = framesOf(files.options, clip);
  CHECK(surfaceError(*frames.back().surfacePhi, clip.at(clip.frames)) < files.accuracy);
  CHECK(carriedError(frames, clip) < 0.1);
  for (const sim::Frame& frame : frames) CHECK(frame.stats.explained.value_or(1.0) > 0.9);
}

}  // namespace

TEST_CASE("cached_flow: free fall, in each way that a cache is written", "[caches]") {
  Clip clip;
  clip.flow = freeFall();
  clip.frames = 5;
  for (const Way way : kWays) {
    INFO(nameOf(way));
    const Scratch scratch;
    const CacheFiles files = writeCache(way, clip, scratch.path);
    const std::vector<sim::Frame> frames = framesOf(files.options, clip);
    CHECK(frames[0].substeps.empty());
    for (int n = 0; n < clip.frames; ++n) {
      const sim::Frame& frame = frames[std::size_t(n)];
      INFO("frame " << n + 1);
      CHECK(frame.index == n + 1);
      CHECK(frame.time == Approx(n / clip.frameRate));
      CHECK(surfaceError(*frame.surfacePhi, clip.at(n + 1)) < files.accuracy);
      // A shift of the surface by `accuracy` cells.
      const double relative = 3.0 * files.accuracy * clip.h / clip.ball.radius;
      CHECK(frame.stats.volume ==
            Approx(4.0 / 3.0 * std::numbers::pi * std::pow(clip.ball.radius, 3)).epsilon(relative + 0.005));
      double seconds = 0.0;
      for (const sim::Substep& substep : frame.substeps) seconds += substep.dt;
      CHECK(seconds == Approx(n == 0 ? 0.0 : 1.0 / clip.frameRate));
    }
    CHECK(frames.back().stats.explained.value_or(0.0) > (files.accuracy > 0.1 ? 0.95 : 0.99));
    // What is fallen in 4 frames of 1/24 s is 0.136 m, 4.4 cells.
    const double fallen = 0.5 * kGravity / 36.0;
    CHECK(carriedError(frames, clip) * clip.h < 0.01 * fallen);
  }
}

TEST_CASE("cached_flow: a whole turn in 96 frames brings points home", "[caches][slow]") {
  for (const Way way : {Way::staggered, Way::ply}) checkTurn(way);
}

TEST_CASE("cached_flow: a whole turn brings points home, in further ways that a cache is written",
          "[caches][long]") {
  for (const Way way :
       {Way::threeGrids, Way::turned, Way::yUpMillimeters, Way::mantaflowMesh, Way::flipFluids, Way::vtk})
    checkTurn(way);
}

TEST_CASE("cached_flow: steady motion, of grids that lie where the surface is", "[caches]") {
  Clip clip;
  clip.flow = translation(Vec3d(0.9, -0.7, 0.5));
  clip.frames = 4;
  for (const Way way : {Way::collocated, Way::mantaflowGrids, Way::plyYUp, Way::plyAndGrids}) {
    INFO(nameOf(way));
    const Scratch scratch;
    const CacheFiles files = writeCache(way, clip, scratch.path);
    const std::vector<sim::Frame> frames = framesOf(files.options, clip);
    CHECK(carriedError(frames, clip) < 0.02);
    for (std::size_t n = 1; n < frames.size(); ++n) CHECK(frames[n].stats.explained.value() > 0.99);
  }
}

TEST_CASE("cached_flow: continues from a state to the same frames", "[caches]") {
  Clip clip;
  clip.flow = freeFall();
  clip.frames = 5;
  const Scratch scratch;
  const CacheFiles files = writeCache(Way::ply, clip, scratch.path);
  CachedFlow whole(cacheOf(files.options, clip));
  for (int n = 0; n < 3; ++n) whole.next();
  CachedFlow rest(cacheOf(files.options, clip), whole.state());
  CHECK(rest.state().frame == 3);
  for (int n = 4; n <= 5; ++n) {
    const sim::Frame a = whole.next(), b = rest.next();
    CHECK(a.index == n);
    CHECK(b.index == n);
    CHECK(a.time == b.time);
    CHECK(a.stats.explained == b.stats.explained);
    CHECK(a.surfacePhi->tree().hasSameTopology(b.surfacePhi->tree()));
    REQUIRE(a.substeps.size() == b.substeps.size());
    for (std::size_t s = 0; s < a.substeps.size(); ++s) {
      CHECK(a.substeps[s].dt == b.substeps[s].dt);
      REQUIRE(a.substeps[s].w->tree().hasSameTopology(b.substeps[s].w->tree()));
      for (auto value = a.substeps[s].w->cbeginValueOn(); value; ++value)
        if (*value != b.substeps[s].w->tree().getValue(value.getCoord())) FAIL("another velocity");
    }
  }
  CHECK_THROWS_WITH(rest.next(), Contains("number 6 is missing (5 is there)"));
}

TEST_CASE("cached_flow: without velocities only where that is asked for", "[caches]") {
  Clip clip;
  clip.flow = translation(Vec3d(1, 0, 0));
  const Scratch scratch;
  Options options = writeCache(Way::plyAndGrids, clip, scratch.path).options;
  options.path = scratch.path / "water.####.ply";
  CHECK_THROWS_WITH(CachedFlow(cacheOf(options, clip)),
                    Contains("water.####.ply") && Contains("no velocities") && Contains("files.fit=true"));
  options.leastExplained = 0.0;
  const std::vector<sim::Frame> frames = framesOf(options, clip);
  REQUIRE(frames[1].substeps.size() == 1);
  CHECK(frames[1].substeps[0].u->activeVoxelCount() == 0);
  const std::vector<Vec3f> points = pointsOn(clip.ball);
  CHECK(transport::traceForward(points, frames[1]) == points);
}

TEST_CASE("cached_flow: velocities in another unit end a run, and the factor is said", "[caches]") {
  Clip clip;
  clip.flow = translation(Vec3d(0.9, -0.7, 0.5));
  clip.frames = 5;
  clip.velocityScale = 1.0 / 24.0;
  for (const Way way : {Way::staggered, Way::ply}) {
    INFO(nameOf(way));
    const Scratch scratch;
    Options options = writeCache(way, clip, scratch.path).options;
    std::string sentence;
    try {
      framesOf(options, clip);
    } catch (const LayoutError& error) {
      sentence = error.what();
    }
    CHECK_THAT(sentence, Contains("explain only") && Contains("files.velocity_scale=24"));
    options.velocityScale = 24.0;
    CHECK(framesOf(options, clip).back().stats.explained.value() > 0.99);
    options.velocityScale = 1.0;
    options.leastExplained = 0.0;
    CHECK(framesOf(options, clip).size() == 5);
  }
}
