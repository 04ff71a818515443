// Points beside walls thinner than the reach of interpolation.
#include "sim/step/solver.h"
#include "transport/backtrace.h"
#include "transport/carry.h"
#include "transport/velocity_sampler.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fluidtex;
using namespace fluidtex::transport;

namespace {

constexpr int kCells = 16;
constexpr double kH = 1.0 / kCells, kFrameRate = 24.0;

// Two pools with a wall between them, across x and as thick as that, in cells; the upper one flows along it
// at a metre a second.
sim::Options pools(double thickness, double middle) {
  const double low = (middle - 0.5 * thickness) * kH, high = (middle + 0.5 * thickness) * kH;
  sim::Options options;
  options.resolution = kCells;
  options.frameRate = kFrameRate;
  options.viscosity = 0.0;
  options.liquid.push_back({.shape = {sim::Box{{0.0, 0.0, 0.0}, {low, 1.0, 0.5}}}});
  options.liquid.push_back(
      {.shape = {sim::Box{{high, 0.0, 0.0}, {1.0, 1.0, 0.5}}}, .velocity = {0.0, 1.0, 0.0}});
  options.solids.resize(1);
  options.solids[0].shape = {sim::Box{{low, -1.0, -1.0}, {high, 2.0, 2.0}}};
  return options;
}

// Where the surface crosses lines between cell centres.
std::vector<Vec3f> surfacePoints(const openvdb::FloatGrid& phi) {
  std::vector<Vec3f> points;
  for (auto value = phi.cbeginValueOn(); value; ++value) {
    for (int axis = 0; axis < 3; ++axis) {
      openvdb::Coord next = value.getCoord();
      next[axis] += 1;
      const double here = *value, there = phi.tree().getValue(next);
      if ((here < 0.0) == (there < 0.0)) continue;
      Vec3d index = value.getCoord().asVec3d();
      index[axis] += here / (here - there);
      points.emplace_back(phi.indexToWorld(index));
    }
  }
  return points;
}

double largest(const Mat3d& a) {
  double result = 0.0;
  for (int i = 0; i < 9; ++i) result = std::max(result, std::abs(a.asPointer()[i]));
  return result;
}

}  // namespace

TEST_CASE("thin walls: a surface at rest does not feel the flow on the wall's other side", "[transport]") {
  // Wherever the wall stands: with samples of velocity on both sides and none in it, or with the centre of a
  // cell in it, so that the surface lies in a cell that belongs to the other side.
  for (const double thickness : {0.6, 0.9, 1.2}) {
    for (const double middle : {8.0, 8.35, 8.5}) {
      CAPTURE(thickness, middle);
      sim::Solver solver(pools(thickness, middle));
      double flowing = 0.0, still = 0.0, slope = 0.0, way = 0.0;
      int count = 0;
      for (int n = 0; n < 4; ++n) {
        const sim::Frame frame = solver.next();
        if (frame.substeps.empty()) continue;
        std::vector<Vec3f> atRest;
        for (const Vec3f& x : surfacePoints(*frame.surfacePhi)) {
          const bool before = x[0] < middle * kH && x[0] > (middle - 2.5) * kH;
          const double speed = velocityAt({x}, frame)[0].length();
          (before ? still : flowing) = std::max(before ? still : flowing, speed);
          if (before) atRest.push_back(x);
        }
        count += int(atRest.size());
        const Backtrace trace = traceBack(atRest, frame);
        const std::vector<Vec3f> ahead = moved(atRest, frame);
        const auto slopes = velocitySlopes(atRest, frame);
        for (std::size_t i = 0; i < atRest.size(); ++i) {
          way = std::max({way, (trace.origin[i] - Vec3d(atRest[i])).length() / kH,
                          double((ahead[i] - atRest[i]).length()) / kH});
          slope = std::max(slope, largest(trace.map[i] - Mat3d::identity()));
          for (const auto& along : slopes) slope = std::max(slope, double(along[i].length()) / kFrameRate);
        }
      }
      CHECK(count > 300);
      CHECK(flowing > 1.0);
      CHECK(still < 0.005);
      CHECK(way < 0.005);
      CHECK(slope < 0.01);
    }
  }
}

TEST_CASE("thin walls: two cells away from them nothing changes", "[transport]") {
  sim::Solver solver(pools(0.6, 8.0));
  solver.next();
  const sim::Frame frame = solver.next();
  sim::Substep open = frame.substeps.back();
  REQUIRE(open.visibility != nullptr);
  open.visibility = nullptr;
  VelocitySampler walls(frame.substeps.back()), none(open);
  int beside = 0;
  for (const Vec3f& point : surfacePoints(*frame.surfacePhi)) {
    const Vec3d x(point);
    const VelocitySample a = walls.velocityAndGradient(x), b = none.velocityAndGradient(x);
    const bool same = a.velocity == b.velocity && a.gradient == b.gradient && a.known == b.known;
    if (std::abs(x[0] - 8.0 * kH) > 2.0 * kH)
      REQUIRE(same);
    else
      beside += same ? 0 : 1;
  }
  CHECK(beside > 0);
}

TEST_CASE("thin walls: samples in a window are those outside it", "[transport]") {
  sim::Solver solver(pools(0.9, 8.35));
  solver.next();
  const sim::Frame frame = solver.next();
  VelocitySampler plain(frame.substeps.back()), focused(frame.substeps.back());
  focused.focus(Vec3d(0.3, 0.0, 0.0), Vec3d(0.7, 1.0, 0.6));
  for (const Vec3f& point : surfacePoints(*frame.surfacePhi)) {
    const VelocitySample a = plain.velocityAndGradient(Vec3d(point)),
                         b = focused.velocityAndGradient(Vec3d(point));
    REQUIRE(a.velocity == b.velocity);
    REQUIRE(a.gradient == b.gradient);
  }
}
