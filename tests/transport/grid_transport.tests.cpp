// The paper's transport over the grid, where it must be exact or has a bound.
#include "transport/grid_transport.h"

#include "tests/threads.h"
#include "tests/transport/orientation_flows.h"
#include "transport/carry.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("coordinate fields: a uniform stream is exact, and no velocity moves nothing", "[transport]") {
  const Vec3d velocity(1.5, -0.75, 0.5);
  const sim::Frame frame = steadyFrame({0.1, -12, 12}, 0.2, 3, constantDirection(velocity));
  const std::vector<Vec3f> points{Vec3f(0.11f, -0.23f, 0.4f), Vec3f(-0.5f, 0.2f, -0.31f)};
  const Backtrace trace = traceOnGrid(points, frame);
  for (std::size_t v = 0; v < points.size(); ++v) {
    CHECK((trace.origin[v] - (Vec3d(points[v]) - velocity * 0.2)).length() < 1e-5);
    CHECK(largestDifference(trace.map[v], Mat3d::identity()) < 1e-4);
    CHECK(trace.known[v] == Approx(1.0f));
  }
  CHECK(traceOnGrid(points, sim::Frame{}).origin[0] == Vec3d(points[0]));
  const Backtrace far = traceOnGrid({Vec3f(9, 9, 9)}, frame);
  CHECK(far.known[0] == 0.0f);
  CHECK(far.origin[0] == Vec3d(9, 9, 9));
}

TEST_CASE("coordinate fields: where no voxel can be, and without a velocity, nothing is known",
          "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -8, 8}, 0.2, 2, constantDirection({1, 0, 0}));
  const std::vector<Vec3f> points{Vec3f(1e30f, 0, 0), Vec3f(0, -3e9f, 0), Vec3f(0, 0, 0)};
  const Backtrace trace = traceOnGrid(points, frame);
  for (std::size_t v = 0; v < 2; ++v) {
    CHECK(trace.known[v] == 0.0f);
    CHECK(trace.origin[v] == Vec3d(points[v]));
  }
  const auto directions = [&](const sim::Frame& of) {
    return directionsOnGrid(points, of, points, constantDirection({0, 1, 0}), true);
  };
  CHECK(directions(frame)[0] == Vec3f(0.0f));
  CHECK(directions(frame)[1] == Vec3f(0.0f));
  CHECK((directions(frame)[2] - Vec3f(0, 1, 0)).length() < 1e-5f);
  for (const Vec3f& direction : directions(sim::Frame{})) CHECK(direction == Vec3f(0.0f));
}

TEST_CASE("carry by the grid: whole, and the same bytes on any number of threads", "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 0.1, 2, linearFlow(rotationAbout({1, 1, 0}, 0.7)));
  const TexturedSurface previous = texturedMesh(sphereMesh(16), constantDirection({0.3, 0.5, 0.8}));
  const SurfaceMesh next = sphereMesh(13);
  const auto run = [&](int threads) {
    return onThreads(threads, [&] {
      return carry(previous, frame, next, 1, {Method::grid, Turning::vector});
    });
  };
  const Carried one = run(1), four = run(4);
  requireWhole(one, next);
  CHECK(std::memcmp(one.orientation.data(), four.orientation.data(),
                    one.orientation.size() * sizeof(Vec3f)) == 0);
  CHECK(std::memcmp(one.coordinate.data(), four.coordinate.data(), one.coordinate.size() * sizeof(Vec2f)) ==
        0);
}

TEST_CASE("carry by the grid: a small turn is followed, by components alone it is not", "[transport]") {
  const double angle = 0.3;
  const Vec3d axis(0, 0, 1);
  const sim::Frame frame = steadyFrame({0.1, -16, 16}, 1.0, 4, linearFlow(rotationAbout(axis, angle)));
  const SurfaceMesh mesh = sphereMesh(10);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({1, 0, 0}));
  const Mat3d turn = exponential(rotationAbout(axis, angle));
  const auto meanError = [&](const Options& options) {
    const Carried carried = carry(previous, frame, mesh, 1, options);
    std::vector<double> errors;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      if (mesh.normals[v].z() < 0.7f) continue;  // where the direction is far from its singular points
      errors.push_back(angleBetween(Vec3d(projected(Vec3f(turn * Vec3d(1, 0, 0)), mesh.normals[v])),
                                    Vec3d(carried.orientation[v])));
    }
    return angleErrors(errors).mean;
  };
  CHECK(meanError({Method::trace, Turning::vector}) < 0.1);
  CHECK(meanError({Method::grid, Turning::vector}) < 1.5);
  CHECK(meanError({Method::trace, Turning::scalars}) > 10.0);
  CHECK(meanError({Method::grid, Turning::scalars}) > 10.0);
}
