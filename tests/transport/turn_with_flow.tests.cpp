#include "transport/turn_with_flow.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::transport;
using openvdb::Vec3d;

namespace {

// D d/Dt = (I - d d^T) A d over `time`, by small steps of the midpoint rule.
Vec3d turnedInSteps(Vec3d d, const Mat3d& slope, double time) {
  constexpr int kSteps = 20000;
  const double dt = time / kSteps;
  const auto rate = [&](const Vec3d& x) {
    const Vec3d change = slope * x;
    return change - x * x.dot(change);
  };
  for (int i = 0; i < kSteps; ++i) d += rate(d + rate(d) * (0.5 * dt)) * dt;
  return d;
}

// d old / d new after `time` of the steady flow u = slope x: exp(-slope time), by its series.
Mat3d backwardMap(const Mat3d& slope, double time) {
  Mat3d sum = Mat3d::identity(), term = Mat3d::identity();
  for (int n = 1; n < 30; ++n) {
    term = term * slope * (-time / n);
    sum = sum + term;
  }
  return sum;
}

double angleBetween(const Vec3f& a, const Vec3d& b) {
  const Vec3d x(a);
  return std::atan2(x.cross(b).length(), x.dot(b));
}

}  // namespace

TEST_CASE("turn with flow: is the solution of equation (4)", "[transport]") {
  const Vec3f up(0.0f, 0.0f, 1.0f), d = Vec3f(0.8f, 0.6f, 0.0f);
  // Flows in the plane, which keep the normal: shear, stretch, turning, all three.
  const Mat3d slopes[] = {Mat3d(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
                          Mat3d(0.7, 0.0, 0.0, 0.0, -0.7, 0.0, 0.0, 0.0, 0.0),
                          Mat3d(0.0, -1.3, 0.0, 1.3, 0.0, 0.0, 0.0, 0.0, 0.0),
                          Mat3d(0.3, -1.1, 0.0, 0.4, -0.5, 0.0, 0.0, 0.0, 0.2)};
  for (const Mat3d& slope : slopes) {
    const Vec3f turned = turnedWithFlow(d, backwardMap(slope, 0.9), up);
    CHECK(turned.length() == Approx(1.0f));
    CHECK(angleBetween(turned, turnedInSteps(Vec3d(d), slope, 0.9)) < 1e-5);
  }
}

TEST_CASE("turn with flow: a rigid turn takes direction and normal along", "[transport]") {
  const Mat3d turn = openvdb::math::rotation<Mat3d>(Vec3d(1.0, 2.0, -0.5).unit(), 0.8);
  const Mat3d back = turn.transpose();
  const Vec3f normal(0.6f, 0.0f, 0.8f), d(0.0f, 1.0f, 0.0f);
  const Vec3f now(turn * Vec3d(normal));
  CHECK((carriedNormal(now, back) - normal).length() < 1e-6f);
  CHECK((turnedWithFlow(d, back, now) - Vec3f(turn * Vec3d(d))).length() < 1e-6f);
}

TEST_CASE("turn with flow: a sheared surface's normal is that of its tangents", "[transport]") {
  // x grows with z: the plane through (1, 0, 0) and (0, 1, 0) stays, that through (0, 0, 1) leans.
  const Mat3d forward(1.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), back = forward.inverse();
  const Vec3d a = forward * Vec3d(0, 1, 0), b = forward * Vec3d(0, 0, 1);
  const Vec3f now(a.cross(b).unit());
  CHECK((carriedNormal(now, back) - Vec3f(1, 0, 0)).length() < 1e-6f);
}

TEST_CASE("turn with flow: a map without an inverse leaves a unit tangent", "[transport]") {
  const Vec3f turned = turnedWithFlow(Vec3f(1, 0, 0), Mat3d::zero(), Vec3f(0, 0, 1));
  CHECK(turned.length() == Approx(1.0f));
  CHECK(turned.z() == Approx(0.0f).margin(1e-6));
}
