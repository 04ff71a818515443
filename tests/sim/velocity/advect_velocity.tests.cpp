#include "sim/velocity/advect_velocity.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace fluidtex::sim;

namespace {

using Field = std::function<Vec3d(const Vec3d&)>;

// Liquid everywhere in the unit box, whose leaves, and one layer more, hold velocities.
struct Fixture {
  double h;
  FloatGrid::Ptr phi, noSolid;
  FloatTree topology{0.0f};

  explicit Fixture(int n) : h(1.0 / n), phi(makePhi(h, 6 * h)), noSolid(makePhi(h, 9 * h)) {
    phi->tree().fill(openvdb::CoordBBox(Coord(-64), Coord(n + 64)), static_cast<float>(-6 * h), false);
    for (int i = -8; i < n + 8; i += 8) {
      for (int j = -8; j < n + 8; j += 8) {
        for (int k = -8; k < 16; k += 8) topology.touchLeaf(Coord(i, j, k))->setValuesOn();
      }
    }
  }

  Velocity set(const Field& field) const { return velocityField(h, topology, field); }

  // Root mean square error of the first two components over faces in the middle of the box.
  double error(const Velocity& velocity, const Field& exact) const {
    double sum = 0.0, count = 0.0;
    for (int a = 0; a < 2; ++a) {
      const FloatGrid& grid = *velocity.component[a];
      for (auto it = grid.cbeginValueOn(); it; ++it) {
        const Vec3d x = grid.indexToWorld(it.getCoord());
        if (x.x() < 0.3 || x.x() > 0.7 || x.y() < 0.3 || x.y() > 0.7 || x.z() < 0.0 || x.z() > 4 * h)
          continue;
        const double difference = *it - exact(x)[a];
        sum += difference * difference;
        count += 1.0;
      }
    }
    REQUIRE(count > 0.0);
    return std::sqrt(sum / count);
  }
};

}  // namespace

TEST_CASE("advect velocity: a uniform stream stays as it is") {
  Fixture f(24);
  const Velocity from = f.set([](const Vec3d&) { return Vec3d(1.0, -0.5, 0.25); });
  Velocity to = makeVelocity(f.h, f.topology);
  advectVelocity(from, from, to, *f.phi, *f.noSolid, 2.5 * f.h);
  CHECK(f.error(to, [](const Vec3d&) { return Vec3d(1.0, -0.5, 0.25); }) < 1e-6);
}

TEST_CASE("advect velocity: shear and stretching, which are linear, are exact but for the trace") {
  Fixture f(24);
  // u = x / (1 + t): the exact solution of u_t + u u_x = 0 from u = x.
  const double dt = 0.05;
  const Velocity from = f.set([](const Vec3d& x) { return Vec3d(x.x(), 0.3 * x.x(), 0.0); });
  Velocity to = makeVelocity(f.h, f.topology);
  advectVelocity(from, from, to, *f.phi, *f.noSolid, dt);
  // x0 = x exp(-dt) along the frozen velocity.
  const double shrink = std::exp(-dt);
  CHECK(f.error(to, [&](const Vec3d& x) { return Vec3d(shrink * x.x(), 0.3 * shrink * x.x(), 0.0); }) < 1e-5);
}

TEST_CASE("advect velocity: second order in space for a smooth pattern in a stream") {
  // v carried by a uniform u; small w keeps the third component busy.
  const double speed = 1.0, time = 0.1;
  double error[3];
  for (int level = 0; level < 3; ++level) {
    Fixture f(24 << level);
    const auto exact = [&](double t) {
      return [=](const Vec3d& x) {
        return Vec3d(speed, std::sin(2.0 * std::numbers::pi * (x.x() - speed * t)), 0.0);
      };
    };
    Velocity velocity = f.set(exact(0.0));
    const int steps = 3 << level;
    for (int n = 0; n < steps; ++n) {
      Velocity to = makeVelocity(f.h, f.topology);
      advectVelocity(velocity, velocity, to, *f.phi, *f.noSolid, time / steps);
      velocity = to;
    }
    error[level] = f.error(velocity, exact(time));
  }
  INFO("errors " << error[0] << " " << error[1] << " " << error[2]);
  CHECK(std::log2(error[0] / error[1]) > 1.7);
  CHECK(std::log2(error[1] / error[2]) > 1.7);
}

TEST_CASE("advect velocity: never beyond the values it came from") {
  Fixture f(24);
  const Velocity from = f.set([](const Vec3d& x) { return Vec3d(1.0, x.x() < 0.5 ? 1.0 : -1.0, 0.0); });
  Velocity to = makeVelocity(f.h, f.topology);
  advectVelocity(from, from, to, *f.phi, *f.noSolid, 1.4 * f.h);
  const FloatGrid& v = *to.component[1];
  for (auto it = v.cbeginValueOn(); it; ++it) {
    const Vec3d x = v.indexToWorld(it.getCoord());
    if (x.x() > 0.2 && x.x() < 0.8) REQUIRE(std::abs(*it) <= 1.0f);
  }
}

TEST_CASE("advect velocity: faces without liquid are left alone") {
  Fixture f(24);
  FloatGrid::Ptr air = makePhi(f.h, 6 * f.h);
  const Velocity from = f.set([](const Vec3d&) { return Vec3d(1.0, 1.0, 1.0); });
  Velocity to = makeVelocity(f.h, f.topology);
  advectVelocity(from, from, to, *air, *f.noSolid, f.h);
  CHECK(maxAbs(to) == 0.0);
}
