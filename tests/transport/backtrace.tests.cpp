#include "transport/backtrace.h"

#include "tests/threads.h"
#include "tests/transport/velocity_grids.h"
#include "transport/carry.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("back-trace: constant velocity is exact", "[transport]") {
  const Vec3d velocity(1.5, -0.75, 0.5);
  const sim::Frame frame = steadyFrame({0.1, -30, 30}, 0.2, 3, [&](const Vec3d&) { return velocity; });
  const std::vector<Vec3f> points = scattered(500, 1.5);
  const Backtrace trace = traceBack(points, frame);
  const std::vector<Vec3f> forward = traceForward(points, frame);
  for (std::size_t v = 0; v < points.size(); ++v) {
    REQUIRE((trace.origin[v] - (Vec3d(points[v]) - velocity * 0.2)).length() < 1e-6);
    REQUIRE((Vec3d(forward[v]) - (Vec3d(points[v]) + velocity * 0.2)).length() < 1e-6);
    REQUIRE(largestDifference(trace.map[v], Mat3d::identity()) < 1e-6);
    REQUIRE(trace.known[v] == Approx(1.0));
  }
}

TEST_CASE("back-trace: substeps are undone in reverse order", "[transport]") {
  // Shear along x by y, then along y by x: the two do not commute.
  const Mat3d first = matrix(0, 1, 0, 0, 0, 0, 0, 0, 0), second = matrix(0, 0, 0, 1, 0, 0, 0, 0, 0);
  const Cells cells{0.1, -30, 30};
  sim::Frame frame;
  frame.substeps = {substep(cells, 0.5, linearFlow(first)), substep(cells, 0.25, linearFlow(second))};
  const Mat3d forward = exponential(second * 0.25) * exponential(first * 0.5);
  const std::vector<Vec3f> points = scattered(200, 1.0);
  const Backtrace trace = traceBack(points, frame);
  const std::vector<Vec3f> ahead = traceForward(points, frame);
  for (std::size_t v = 0; v < points.size(); ++v) {
    REQUIRE((forward * trace.origin[v] - Vec3d(points[v])).length() < 1e-6);
    REQUIRE(largestDifference(trace.map[v], forward.inverse()) < 1e-5);
    REQUIRE((Vec3d(ahead[v]) - forward * Vec3d(points[v])).length() < 1e-6);
  }
}

TEST_CASE("back-trace: map and its gradient of linear flows", "[transport]") {
  const std::vector<std::pair<const char*, Mat3d>> flows{
      {"rotation", rotationAbout({1, 2, 2}, 1.0)},
      {"simple shear", matrix(0, 1, 0, 0, 0, 0, 0, 0, 0)},
      {"planar strain", matrix(1, 0, 0, 0, -1, 0, 0, 0, 0)},
      {"triaxial strain", matrix(0.5, 0, 0, 0, 0.25, 0, 0, 0, -0.75)},
      {"general, without divergence", matrix(0.3, -0.8, 0.2, 0.5, 0.1, -0.4, 0.6, 0.2, -0.4)}};
  for (const auto& [name, a] : flows) {
    INFO(name);
    const double time = 0.3;
    const sim::Frame frame = steadyFrame({0.1, -20, 20}, time, 4, linearFlow(a));
    const std::vector<Vec3f> points = scattered(200, 1.0);
    const Backtrace trace = traceBack(points, frame);
    const Mat3d back = exponential(a * -time);
    for (std::size_t v = 0; v < points.size(); ++v) {
      REQUIRE((trace.origin[v] - back * Vec3d(points[v])).length() < 1e-5);
      REQUIRE(largestDifference(trace.map[v], back) < 2e-5);
    }
  }
}

TEST_CASE("back-trace: the gradient is that of the traced map, over a voxel", "[transport]") {
  const Flow swirl = [](const Vec3d& x) {
    const double rate = 3.0 * std::exp(-(x.x() * x.x() + x.y() * x.y()));
    return Vec3d(-rate * x.y(), rate * x.x(), 0.3 * std::sin(3 * x.x()));
  };
  const sim::Frame frame = steadyFrame({0.05, -40, 40}, 0.2, 2, swirl);
  // Inner steps depend on the local speed; a flow of one step a substep has one formula everywhere.
  const float step = 0.025f;  // half a voxel
  double sum = 0.0;
  const std::vector<Vec3f> points = scattered(300, 0.8);
  const Backtrace trace = traceBack(points, frame);
  for (int j = 0; j < 3; ++j) {
    std::vector<Vec3f> ahead = points, behind = points;
    for (Vec3f& x : ahead) x[j] += step;
    for (Vec3f& x : behind) x[j] -= step;
    const Backtrace a = traceBack(ahead, frame), b = traceBack(behind, frame);
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Vec3d slope = (a.origin[v] - b.origin[v]) / (double(ahead[v][j]) - double(behind[v][j]));
      sum += (slope - trace.map[v].col(j)).length();
    }
  }
  CHECK(sum / (3.0 * points.size()) < 5e-3);
}

TEST_CASE("back-trace: a full turn brings every point home, with third order in the step", "[transport]") {
  const Cells cells{0.1, -16, 16};
  const Flow turn = linearFlow(rotationAbout({0, 0, 1}, 2 * std::numbers::pi));
  const sim::Substep velocity = substep(cells, 1.0, turn);
  // Near the axis: one inner step a substep for all counts below.
  const std::vector<Vec3f> points = scattered(100, 0.15);
  std::vector<double> errors;
  for (const int substeps : {100, 200, 400}) {
    sim::Frame frame;
    frame.substeps.assign(substeps, velocity);
    for (sim::Substep& step : frame.substeps) step.dt = 1.0 / substeps;
    const Backtrace trace = traceBack(points, frame);
    double worst = 0.0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      worst = std::max(worst, (trace.origin[v] - Vec3d(points[v])).length());
    }
    errors.push_back(worst);
  }
  CHECK(errors[0] < 0.02 * cells.h);
  CHECK(std::log2(errors[0] / errors[1]) > 2.8);
  CHECK(std::log2(errors[1] / errors[2]) > 2.8);
}

TEST_CASE("back-trace: fast flow is followed in steps of about one cell", "[transport]") {
  // Ten cells in one substep around a circle of ten cells' radius: one step would miss it by several cells.
  const double rate = 1.0;
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 1.0, 1, linearFlow(rotationAbout({0, 0, 1}, rate)));
  const std::vector<Vec3f> points{Vec3f(1, 0, 0), Vec3f(0, -1, 0.3f)};
  const Backtrace trace = traceBack(points, frame);
  const Mat3d back = exponential(rotationAbout({0, 0, 1}, -rate));
  for (std::size_t v = 0; v < points.size(); ++v) {
    CHECK((trace.origin[v] - back * Vec3d(points[v])).length() < 0.001 * 0.1);
  }
}

TEST_CASE("back-trace: where the velocity is unknown the point stays and is not believed", "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -8, 8}, 1.0, 2, [](const Vec3d&) { return Vec3d(0.5, 0, 0); });
  const Backtrace trace = traceBack({Vec3f(3, 0, 0), Vec3f(-0.6f, 0, 0), Vec3f(0.3f, 0, 0)}, frame);
  CHECK(trace.origin[0] == Vec3d(3, 0, 0));
  CHECK(trace.known[0] == 0.0f);
  CHECK(trace.known[1] > 0.1f);  // leaves the known part on its way
  CHECK(trace.known[1] < 0.9f);
  CHECK(trace.known[2] == Approx(1.0f));
}

TEST_CASE("back-trace: a velocity that is not finite is unknown", "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -4, 4}, 1.0, 1, [](const Vec3d&) {
    return Vec3d(std::numeric_limits<double>::infinity(), 0.0, std::numeric_limits<double>::quiet_NaN());
  });
  const Backtrace trace = traceBack({Vec3f(0.01f, 0.02f, 0.03f)}, frame);
  CHECK((trace.origin[0] - Vec3d(0.01, 0.02, 0.03)).length() < 1e-8);
  CHECK(trace.known[0] == Approx(1.0 / 3.0));  // v alone
}

TEST_CASE("back-trace: forward and back again", "[transport]") {
  const Flow cells = [](const Vec3d& x) {
    return Vec3d(std::sin(2 * x.x()) * std::cos(2 * x.y()), -std::cos(2 * x.x()) * std::sin(2 * x.y()), 0.2);
  };
  const sim::Frame frame = steadyFrame({0.05, -40, 40}, 0.25, 4, cells);
  const std::vector<Vec3f> points = scattered(500, 1.2), ahead = moved(points, frame);
  const Backtrace trace = traceBack(ahead, frame);
  for (std::size_t v = 0; v < points.size(); ++v) {
    REQUIRE((trace.origin[v] - Vec3d(points[v])).length() < 0.002 * 0.05);
  }
}

TEST_CASE("back-trace: no substeps and no points", "[transport]") {
  const sim::Frame still;
  const Backtrace trace = traceBack({Vec3f(1, 2, 3)}, still);
  CHECK(trace.origin[0] == Vec3d(1, 2, 3));
  CHECK(trace.known[0] == 1.0f);
  CHECK(traceBack({}, steadyFrame({0.1, -2, 2}, 1.0, 1, [](const Vec3d&) { return Vec3d(1.0); }))
            .origin.empty());
}

TEST_CASE("back-trace: the same bytes on any number of threads and in any order of points", "[transport]") {
  const Flow swirl = [](const Vec3d& x) { return Vec3d(-x.y() + 0.1 * x.z(), x.x(), std::sin(4 * x.x())); };
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.3, 3, swirl);
  const std::vector<Vec3f> points = scattered(3000, 1.0);
  const auto run = [&](int threads, const std::vector<Vec3f>& from) {
    return onThreads(threads, [&] { return traceBack(from, frame); });
  };
  const Backtrace one = run(1, points), four = run(4, points);
  CHECK(std::memcmp(one.origin.data(), four.origin.data(), points.size() * sizeof(Vec3d)) == 0);
  CHECK(std::memcmp(one.map.data(), four.map.data(), points.size() * sizeof(Mat3d)) == 0);
  const Backtrace reversed = run(1, {points.rbegin(), points.rend()});
  for (std::size_t v = 0; v < points.size(); ++v)
    REQUIRE(reversed.origin[points.size() - 1 - v] == one.origin[v]);
}
