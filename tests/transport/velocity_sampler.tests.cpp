#include "transport/velocity_sampler.h"

#include "tests/transport/velocity_grids.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;
using openvdb::Vec3f;

TEST_CASE("velocity sampler: exact for a linear flow, in value and gradient, across leaves", "[transport]") {
  const Mat3d a = matrix(0.5, 1.0, -0.25, 2.0, -1.5, 0.125, 0.75, -0.5, 1.0);
  const Vec3d c(0.25, -1.0, 2.0);
  const Cells cells{0.125, -20, 20};
  VelocitySampler sampler(substep(cells, 1.0, [&](const Vec3d& x) { return a * x + c; }));
  CHECK(sampler.voxelSize() == Approx(0.125));
  for (const Vec3f& point : scattered(2000, 2.3)) {
    const Vec3d x(point);
    const VelocitySample sample = sampler.velocityAndGradient(x);
    REQUIRE(sample.known == Approx(1.0));
    REQUIRE((sample.velocity - (a * x + c)).length() < 1e-5);
    REQUIRE(largestDifference(sample.gradient, a) < 1e-4);
    REQUIRE((sampler.velocity(x).velocity - sample.velocity).length() == 0.0);
  }
}

TEST_CASE("velocity sampler: the gradient is the interpolated velocity's difference over a voxel",
          "[transport]") {
  const Flow wavy = [](const Vec3d& x) {
    return Vec3d(std::sin(3 * x.y()) + x.x() * x.z(), std::cos(2 * x.x() * x.z()), x.x() * x.y() * x.z());
  };
  const Cells cells{0.1, -12, 12};
  VelocitySampler sampler(substep(cells, 1.0, wavy));
  for (const Vec3f& point : scattered(500, 0.9)) {
    const Vec3d x(point);
    const Mat3d gradient = sampler.velocityAndGradient(x).gradient;
    for (int j = 0; j < 3; ++j) {
      Vec3d offset(0.0);
      offset[j] = 0.5 * cells.h;
      const Vec3d slope =
          (sampler.velocity(x + offset).velocity - sampler.velocity(x - offset).velocity) / cells.h;
      for (int i = 0; i < 3; ++i) REQUIRE(slope[i] == Approx(gradient(i, j)).margin(1e-5));
    }
  }
}

TEST_CASE("velocity sampler: beside unknown values the gradient is the cell's own", "[transport]") {
  const Mat3d a = matrix(0.5, 1.0, -0.25, 2.0, -1.5, 0.125, 0.75, -0.5, 1.0);
  VelocitySampler sampler(substep({0.1, -8, 8}, 1.0, linearFlow(a)));
  const VelocitySample rim = sampler.velocityAndGradient(Vec3d(0.74, 0.74, -0.78));
  CHECK(rim.known == Approx(1.0));
  CHECK(largestDifference(rim.gradient, a) < 1e-4);
}

TEST_CASE("velocity sampler: what is inactive is unknown", "[transport]") {
  const Cells cells{0.1, -8, 8};
  sim::Substep step = substep(cells, 1.0, [](const Vec3d&) { return Vec3d(1, 2, 3); });
  VelocitySampler whole(step);
  CHECK(whole.velocity(Vec3d(5, 0, 0)).known == 0.0);
  CHECK(whole.velocity(Vec3d(5, 0, 0)).velocity == Vec3d(0.0));
  // Half over the rim: the active values stand for the missing ones.
  const VelocitySample rim = whole.velocity(Vec3d(0.83, 0.02, 0.01));
  CHECK(rim.known > 0.0);
  CHECK(rim.known < 1.0);
  CHECK((rim.velocity - Vec3d(1, 2, 3)).length() < 1e-6);
  step.w = nullptr;
  VelocitySampler partial(step);
  CHECK(partial.velocity(Vec3d(0.0)).known == Approx(2.0 / 3.0));
  CHECK((partial.velocity(Vec3d(0.0)).velocity - Vec3d(1, 2, 0)).length() < 1e-6);
}

TEST_CASE("velocity sampler: constant tiles are read like leaves", "[transport]") {
  sim::Substep step;
  for (auto* grid : {&step.u, &step.v, &step.w}) {
    auto filled = sim::FloatGrid::create(0.0f);
    filled->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    filled->fill(openvdb::CoordBBox(openvdb::Coord(-64), openvdb::Coord(63)), 4.0f, true);
    REQUIRE(filled->tree().leafCount() == 0);
    *grid = filled;
  }
  VelocitySampler sampler(step);
  const VelocitySample sample = sampler.velocityAndGradient(Vec3d(0.21, -0.37, 1.99));
  CHECK(sample.known == Approx(1.0));
  CHECK((sample.velocity - Vec3d(4.0)).length() < 1e-6);
  CHECK(largestDifference(sample.gradient, Mat3d::zero()) == 0.0);
}

TEST_CASE("velocity sampler: what is laid side by side changes no sample by a bit", "[transport]") {
  const Flow wavy = [](const Vec3d& x) {
    return Vec3d(std::sin(3 * x.y()) + x.z(), std::cos(2 * x.x() * x.z()), x.x() * x.y());
  };
  sim::Substep step = substep({0.1, -11, 11}, 1.0, wavy);
  // Holes, and a tile.
  const auto thinned = std::const_pointer_cast<sim::FloatGrid>(step.v);
  for (auto value = thinned->beginValueOn(); value; ++value) {
    const openvdb::Coord c = value.getCoord();
    if ((c.x() * 7 + c.y() * 3 + c.z() * 5) % 11 == 0) value.setValueOff();
  }
  std::const_pointer_cast<sim::FloatGrid>(step.w)->tree().addTile(1, openvdb::Coord(0), 2.5f, true);
  VelocitySampler plain(step), focused(step);
  const Vec3d lower(-0.5, -0.93, 0.17), upper(1.6, 0.4, 0.9);
  focused.focus(lower, upper);
  const auto same = [](const VelocitySample& a, const VelocitySample& b) {
    return a.velocity == b.velocity && a.gradient == b.gradient && a.known == b.known;
  };
  int within = 0, whole = 0;
  for (const Vec3f& point : scattered(4000, 1.5)) {
    const Vec3d x(point);
    const VelocitySample sample = plain.velocityAndGradient(x);
    REQUIRE(same(sample, focused.velocityAndGradient(x)));
    REQUIRE(plain.velocity(x).velocity == focused.velocity(x).velocity);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside &= x[axis] > lower[axis] && x[axis] < upper[axis];
    within += inside;
    whole += inside && sample.known == 1.0;
  }
  CHECK(within > 200);
  CHECK(whole > 20);
  CHECK(whole < within);
}

TEST_CASE("velocity sampler: beyond any grid nothing is known", "[transport]") {
  VelocitySampler sampler(substep({0.1, -4, 4}, 1.0, [](const Vec3d&) { return Vec3d(1.0); }));
  for (const double far : {1e12, -1e30, std::numeric_limits<double>::infinity()}) {
    sampler.focus(Vec3d(-0.1), Vec3d(0.1));
    sampler.focus(Vec3d(0.0), Vec3d(far, 0.0, 0.0));
    CHECK(sampler.velocity(Vec3d(far, 0.0, 0.0)).known == 0.0);
    CHECK(sampler.velocity(Vec3d(0.01)).known == 1.0);
  }
}

TEST_CASE("velocity sampler: transforms that turn are refused", "[transport]") {
  sim::Substep step = substep({0.1, -2, 2}, 1.0, [](const Vec3d&) { return Vec3d(1.0); });
  auto turned = sim::FloatGrid::create(0.0f);
  auto transform = openvdb::math::Transform::createLinearTransform(0.1);
  transform->postRotate(0.3, openvdb::math::Z_AXIS);
  turned->setTransform(transform);
  step.v = turned;
  CHECK_THROWS_AS(VelocitySampler(step), std::invalid_argument);
}
