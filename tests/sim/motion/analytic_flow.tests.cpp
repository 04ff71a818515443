// Frames of flows known in closed form: velocity and surface against the formulas.
#include "sim/motion/analytic_flow.h"

#include "tests/sim/motion/ball.h"

#include <openvdb/tools/Interpolation.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

Options sheet() {
  Options options;
  options.size = Vec3d(1.0, 1.0, 0.5);
  options.resolution = 32;
  options.liquid = {{Shape{Box{Vec3d(-1, -1, 0.2), Vec3d(2, 2, 0.32)}}}};
  return options;
}

Vec3d velocityAt(const Substep& substep, const Vec3d& x) {
  const FloatGrid* const grids[3] = {substep.u.get(), substep.v.get(), substep.w.get()};
  Vec3d velocity;
  for (int axis = 0; axis < 3; ++axis)
    velocity[axis] =
        openvdb::tools::BoxSampler::sample(grids[axis]->constTree(), grids[axis]->worldToIndex(x));
  return velocity;
}

double phiAt(const Frame& frame, const Vec3d& x) {
  return openvdb::tools::BoxSampler::sample(frame.surfacePhi->constTree(), frame.surfacePhi->worldToIndex(x));
}

// Those of the first point and of as many frames as given.
Frame frameAfter(AnalyticFlow& flow, int frames) {
  Frame frame = flow.next();
  for (int n = 0; n < frames; ++n) frame = flow.next();
  return frame;
}

}  // namespace

TEST_CASE("analytic flow: nothing moves at rest, and the surface keeps its bytes", "[sim]") {
  AnalyticFlow flow(ball(Vec3d(0.5), 0.3), {MotionKind::rest});
  const Frame first = flow.next(), second = flow.next();
  CHECK(first.substeps.empty());
  REQUIRE(second.substeps.size() == 1);
  CHECK_THAT(second.substeps[0].dt, WithinAbs(1.0 / 24.0, 1e-12));
  CHECK(velocityAt(second.substeps[0], Vec3d(0.5, 0.5, 0.8)) == Vec3d(0.0));
  auto before = first.surfacePhi->cbeginValueOn(), after = second.surfacePhi->cbeginValueOn();
  for (; before; ++before, ++after)
    REQUIRE((after && before.getCoord() == after.getCoord() && *before == *after));
  CHECK_THAT(first.stats.volume, WithinAbs(0.036 * std::numbers::pi, 0.001));
}

TEST_CASE("analytic flow: a sheet is stretched along x and stays where it is", "[sim]") {
  AnalyticFlow flow(sheet(), {MotionKind::stretch, 1.0, 0.8});
  const Frame frame = frameAfter(flow, 2);
  for (const Vec3d& x : {Vec3d(0.1, 0.4, 0.32), Vec3d(0.5, 0.9, 0.2), Vec3d(0.93, 0.2, 0.26)}) {
    const Vec3d u = velocityAt(frame.substeps[0], x);
    CHECK_THAT(u[0], WithinAbs(0.8 * (x[0] - 0.5), 1e-6));
    CHECK((u[1] == 0.0 && u[2] == 0.0));
  }
  CHECK_THAT(phiAt(frame, Vec3d(0.5, 0.5, 0.32)), WithinAbs(0.0, 1e-6));
  CHECK_THAT(phiAt(frame, Vec3d(0.2, 0.7, 0.2)), WithinAbs(0.0, 1e-6));
}

TEST_CASE("analytic flow: area grows by the rate at the source and is lost at the sink", "[sim]") {
  const double rate = 1.5, h = 1.0 / 32;
  AnalyticFlow flow(sheet(), {MotionKind::sourceSink, 1.0, rate});
  const Substep substep = frameAfter(flow, 1).substeps.at(0);
  const auto growth = [&](double x, double y) {
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      Vec3d low(x, y, 0.3), high = low;
      low[axis] -= h;
      high[axis] += h;
      sum += (velocityAt(substep, high)[axis] - velocityAt(substep, low)[axis]) / (2.0 * h);
    }
    return sum;
  };
  // The second difference of sin(3 pi x) over 2 h.
  const double tolerance = rate * std::pow(3.0 * std::numbers::pi * h, 2) / 3.0;
  CHECK_THAT(growth(2.0 / 3.0, 2.0 / 3.0), WithinAbs(rate, tolerance));
  CHECK_THAT(growth(1.0 / 3.0, 1.0 / 3.0), WithinAbs(-rate, tolerance));
  for (const double y : {0.1, 0.5, 0.8}) {
    CHECK_THAT(velocityAt(substep, Vec3d(0.0, y, 0.3))[0], WithinAbs(0.0, 1e-6));
    CHECK_THAT(velocityAt(substep, Vec3d(y, 1.0, 0.3))[1], WithinAbs(0.0, 1e-6));
  }
}

TEST_CASE("analytic flow: a sheet out of a slit is drawn out by the strain and widens with the slit",
          "[sim]") {
  Options options = sheet();
  options.liquid = {{Shape{Box{Vec3d(-1, 0.3, 0.2), Vec3d(2, 0.7, 0.32)}}}};
  const double speed = 0.6, strain = 0.8, widening = 0.3;
  AnalyticFlow flow(options,
                    {.flow = MotionKind::slot, .speed = speed, .strain = strain, .widening = widening});
  const Frame frame = frameAfter(flow, 12);
  const Substep& substep = frame.substeps.at(0);
  for (const Vec3d& x : {Vec3d(0.1, 0.4, 0.3), Vec3d(0.5, 0.9, 0.2), Vec3d(0.93, 0.2, 0.26)}) {
    const Vec3d u = velocityAt(substep, x);
    CHECK_THAT(u[0], WithinAbs(speed + strain * x[0], 1e-6));
    CHECK((u[1] == 0.0 && u[2] == 0.0));
  }
  CHECK_THAT(velocityAt(substep, Vec3d(-0.1, 0.5, 0.3))[0], WithinAbs(speed, 1e-6));
  // dx / dt = speed + strain x: what is at x has left the slit ln(1 + strain x / speed) / strain ago.
  for (const double x : {0.1, 0.2}) {
    const double left = 0.5 - std::log(1.0 + strain * x / speed) / strain;
    CHECK_THAT(phiAt(frame, Vec3d(x, 0.7 + widening * left, 0.26)), WithinAbs(0.0, 0.1 / 32));
    CHECK_THAT(phiAt(frame, Vec3d(x, 0.3 - widening * left, 0.26)), WithinAbs(0.0, 0.1 / 32));
  }
  CHECK_THAT(phiAt(frame, Vec3d(0.9, 0.7, 0.26)), WithinAbs(0.0, 1e-3));
  CHECK_THAT(phiAt(frame, Vec3d(0.5, 0.5, 0.32)), WithinAbs(0.0, 1e-6));
}

TEST_CASE("analytic flow: a ball turns about the middle", "[sim]") {
  const double rate = 0.5 * std::numbers::pi * 24.0 / 6.0;  // a quarter in six frames
  AnalyticFlow flow(ball(Vec3d(0.75, 0.5, 0.5), 0.15), {MotionKind::rotation, 1.0, rate});
  const Frame frame = frameAfter(flow, 6);
  // Linear between the cells of 1/32 m, a distance is off by about h^2 / 4 of its curvature, 1/0.15.
  for (const Vec3d& out : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, -1), Vec3d(0.6, 0.0, 0.8)})
    CHECK_THAT(phiAt(frame, Vec3d(0.5, 0.75, 0.5) + 0.15 * out), WithinAbs(0.0, 0.3 / (32 * 32 * 0.15)));
  const Vec3d u = velocityAt(frame.substeps[0], Vec3d(0.5, 0.9, 0.5));
  CHECK_THAT(u[0], WithinAbs(-0.4 * rate, 1e-4));
  CHECK_THAT(u[1], WithinAbs(0.0, 1e-4));
}

TEST_CASE("analytic flow: a vortex turns by its rate and turns back after half its period", "[sim]") {
  const MotionOptions motion{MotionKind::vortex, 8.0 / 24.0, 6.0};
  AnalyticFlow flow(ball(Vec3d(0.5, 0.75, 0.5), 0.15), motion);
  const Frame early = frameAfter(flow, 1);
  const double r = 1.0 / 32;
  const double strength = std::cos(std::numbers::pi * 0.5 * early.substeps[0].dt / motion.period);
  CHECK_THAT(velocityAt(early.substeps[0], Vec3d(0.5 + r, 0.5, 0.6))[1] / r,
             WithinAbs(-motion.rate * strength, 0.15));
  for (const Substep& substep : early.substeps)
    CHECK(substep.dt * velocityAt(substep, Vec3d(0.5, 0.75, 0.5)).length() < 1.0 / 32);
  Frame last;
  for (int n = 0; n < 7; ++n) last = flow.next();
  CHECK_THAT(last.time, WithinAbs(motion.period, 1e-12));
  for (const Vec3d& out : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1)})
    CHECK_THAT(phiAt(last, Vec3d(0.5, 0.75, 0.5) + 0.15 * out), WithinAbs(0.0, 0.2 / 32));
}

TEST_CASE("analytic flow: the deformation goes as far in any period, and keeps the volume", "[sim]") {
  double volume[2];
  Vec3d top[2];
  for (const int frames : {4, 8}) {
    AnalyticFlow flow(ball(Vec3d(0.35), 0.15), {MotionKind::deformation, 4.0 * frames / 24.0});
    const double before = flow.next().stats.volume;
    Frame frame;
    for (int n = 0; n < frames; ++n) frame = flow.next();  // a quarter of the period
    volume[frames / 8] = frame.stats.volume;
    top[frames / 8] = frame.surfacePhi->indexToWorld(frame.surfacePhi->evalActiveVoxelBoundingBox().max());
    CHECK_THAT(frame.stats.volume, WithinAbs(before, 0.05 * before));  // the ball is ten cells across
  }
  CHECK((top[0] - top[1]).length() <= std::sqrt(3.0) / 32);
  CHECK_THAT(volume[0], WithinAbs(volume[1], 0.02 * volume[1]));
}

TEST_CASE("analytic flow: a rate that no number of substeps can follow is refused", "[sim]") {
  AnalyticFlow flow(ball(Vec3d(0.5, 0.75, 0.5), 0.15), {MotionKind::vortex, 8.0, 1e12});
  flow.next();
  CHECK_THROWS_AS(flow.next(), SolverError);
}
