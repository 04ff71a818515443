#include "sim/viscosity/viscosity.h"

#include "sim/viscosity/viscous_system.h"
#include "tests/sim/viscosity/viscous_tank.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const auto everywhere = [](const Vec3d&) { return true; };

// A channel between the floor and a lid, 8 cells deep in y where walls slip; flow along x.
struct Channel {
  Options options;
  Channel(int n, double length) : options(tankOf(static_cast<int>(n * length), {length, 8.0 / n, 1.0})) {
    for (const DomainFace face : {DomainFace::xLow, DomainFace::xHigh, DomainFace::zLow, DomainFace::zHigh})
      options.walls.push_back({face, {.kind = WallKind::noSlip}});
  }
};

}  // namespace

TEST_CASE("applyViscosity: a translation is left as it is, to the last bit", "[sim]") {
  const Field wind = [](const Vec3d&) { return Vec3d(0.3, -1.7, 2.1); };
  Tank tank(tankOf(24), dropDistance, wind);
  const auto report = tank.apply(1e4);
  CHECK(report.converged);
  CHECK(report.iterations == 0);
  CHECK(tank.error(wind, everywhere) < 1e-6);
}

TEST_CASE("applyViscosity: rigid rotation has no strain", "[sim]") {
  const Field spin = [](const Vec3d& x) { return Vec3d(1.0, 2.0, -3.0).cross(x - Vec3d(0.5, 0.4, 0.6)); };
  for (const double number : {1.0, 1e3, 1e5}) {
    Tank tank(tankOf(24), dropDistance, spin);
    CHECK(tank.apply(number).converged);
    CHECK(tank.error(spin, everywhere) < 1e-4);
  }
}

TEST_CASE("applyViscosity: a free drop keeps its momentum and its spin", "[sim]") {
  Tank tank(tankOf(24), dropDistance, mixed);
  std::vector<double> before, after;
  const double dt = 0.01, viscosity = 50.0 * kDensity * tank.h * tank.h / dt;
  const ViscousSystem system =
      viscousSystem(tank.velocity, *tank.phi, tank.solid, dt, kDensity, {.constant = viscosity}, before);
  after = before;
  CHECK(solveViscous(system, after, {.tolerance = 1e-11}).converged);
  Vec3d momentum(0.0), spin(0.0), oldMomentum(0.0), oldSpin(0.0);
  double energy = 0.0, oldEnergy = 0.0;
  for (int c = 0; c < 3; ++c) {
    for (std::int32_t f = system.start[c].front(); f < system.start[c].back(); ++f) {
      const Vec3d x = tank.velocity.component[c]->indexToWorld(system.coord[f]);
      for (const bool old : {true, false}) {
        Vec3d p(0.0);
        p[c] = system.mass[f] * (old ? before[f] : after[f]);
        (old ? oldMomentum : momentum) += p;
        (old ? oldSpin : spin) += x.cross(p);
        (old ? oldEnergy : energy) += 0.5 * p.lengthSqr() / system.mass[f];
      }
    }
  }
  CHECK((momentum - oldMomentum).length() < 1e-7 * oldMomentum.length());
  CHECK((spin - oldSpin).length() < 1e-7 * oldSpin.length());
  CHECK(energy < 0.9 * oldEnergy);
  // The mass is the drop's, surface cells by their share.
  double mass = 0.0;
  for (const float m : system.mass) mass += m / 3.0;
  CHECK_THAT(mass * std::pow(tank.h, 3.0), WithinRel(4.0 / 3.0 * M_PI * std::pow(0.31, 3.0), 0.01));
}

TEST_CASE("applyViscosity: between moving plates the profile is a straight line", "[sim]") {
  const Channel channel(8, 2.0);
  const Field profile = [](const Vec3d& x) { return Vec3d(std::clamp(x[2], 0.0, 1.0), 0.0, 0.0); };
  Tank tank(
      channel.options, [](const Vec3d&) { return -1.0; }, [](const Vec3d&) { return Vec3d(0.0); });
  tank.setWallVelocity(profile);
  CHECK(tank.apply(1e6).converged);
  CHECK(tank.error(profile, everywhere) < 1e-4);
}

TEST_CASE("applyViscosity: a plate between the faces is where its distance says", "[sim]") {
  for (const double height : {0.14, 0.2, 0.23}) {
    Channel channel(8, 2.0);
    channel.options.solids.emplace_back();
    channel.options.solids.back().shape.kind = HalfSpace{{0.0, 0.0, height}, {0.0, 0.0, 1.0}};
    channel.options.solids.back().wall.kind = WallKind::noSlip;
    const Field profile = [=](const Vec3d& x) {
      return Vec3d(std::clamp((x[2] - height) / (1.0 - height), 0.0, 1.0), 0.0, 0.0);
    };
    Tank tank(
        channel.options, [](const Vec3d&) { return -1.0; }, [](const Vec3d&) { return Vec3d(0.0); });
    tank.setWallVelocity(profile);
    CHECK(tank.apply(1e6, {.tolerance = 1e-10}).converged);
    // Exact, but for cells that have plate and side wall at once: there the solid's distance has a crease.
    CHECK(tank.error(profile, everywhere) < 0.01);
  }
}

TEST_CASE("applyViscosity: with a slip length the profile starts that far behind the wall", "[sim]") {
  constexpr double kSlip = 0.3;
  Channel channel(8, 3.0);
  channel.options.walls.push_back({DomainFace::zLow, {WallKind::friction, kSlip, Vec3d(0.0)}});
  const Field profile = [](const Vec3d& x) {
    return Vec3d((std::min(x[2], 1.0) + kSlip) / (1.0 + kSlip), 0.0, 0.0);
  };
  Tank tank(
      channel.options, [](const Vec3d&) { return -1.0; }, [](const Vec3d&) { return Vec3d(0.0); });
  tank.setWallVelocity([&](const Vec3d& x) { return x[2] < 0.0 ? Vec3d(0.0) : profile(x); });
  CHECK(tank.apply(1e6).converged);
  CHECK(tank.error(profile, everywhere) < 1e-3);
}

TEST_CASE("applyViscosity: Poiseuille flow is right to h^2 / 8", "[sim]") {
  // nu = 1, G = 1: u = z (1 - z) / 2. One step as long as it takes to be steady.
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    const Channel channel(n, 3.0);
    const double number = 1e5 * n * n;  // dt / h^2
    const Field profile = [](const Vec3d& x) {
      const double z = std::clamp(x[2], 0.0, 1.0);
      return Vec3d(0.5 * z * (1.0 - z), 0.0, 0.0);
    };
    const double h = channel.options.voxelSize(), dt = number * h * h;
    Tank tank(
        channel.options, [](const Vec3d&) { return -1.0; }, [&](const Vec3d&) { return Vec3d(dt, 0, 0); });
    tank.setWallVelocity(profile);
    CHECK(tank.apply(number, {.tolerance = 1e-10}).converged);
    errors.push_back(tank.error(profile, [](const Vec3d& x) { return std::abs(x[0] - 1.5) < 0.2; }));
    CHECK_THAT(errors.back(), WithinRel(h * h / 8.0, 0.02));
  }
}

TEST_CASE("applyViscosity: a film's profile is right wherever its surface lies", "[sim]") {
  // Down a slope, u = z depth - z^2 / 2 with nu = G = 1; no stress at the surface.
  for (const double depth : {0.5, 0.53, 0.56, 0.6}) {
    const Channel channel(16, 3.0);
    const double number = 1e5, h = channel.options.voxelSize(), dt = number * h * h;
    const Field profile = [=](const Vec3d& x) {
      const double z = std::clamp(x[2], 0.0, depth);
      return Vec3d(z * depth - 0.5 * z * z, 0.0, 0.0);
    };
    Tank tank(
        channel.options, [=](const Vec3d& x) { return x[2] - depth; },
        [&](const Vec3d&) { return Vec3d(dt, 0, 0); });
    tank.setWallVelocity(profile);
    CHECK(tank.apply(number, {.tolerance = 1e-9}).converged);
    // Half of the error is that of any wall, h^2 / 8.
    CHECK(tank.error(profile, [](const Vec3d& x) { return std::abs(x[0] - 1.5) < 0.2; }) < h * h / 4.0);
  }
}

TEST_CASE("applyViscosity: between a turning and a resting sphere", "[sim]") {
  // Stokes: u = w x r (A + B / r^3), without pressure.
  constexpr double kInner = 0.2, kOuter = 0.42;
  const double b = 1.0 / (std::pow(kInner, -3.0) - std::pow(kOuter, -3.0)), a = -b * std::pow(kOuter, -3.0);
  const Field exact = [=](const Vec3d& x) {
    const Vec3d r = x - Vec3d(0.5);
    const double length = std::clamp(r.length(), kInner, kOuter);
    return Vec3d(0.3, 0.5, 1.0).cross(r) * (a + b / std::pow(length, 3.0));
  };
  std::vector<double> errors;
  for (const int n : {12, 24, 48}) {
    Options options = tankOf(n);
    options.solids.resize(2);
    options.solids[0].shape.kind = Sphere{Vec3d(0.5), kInner};
    Difference shell;
    shell.parts = {Shape{Box{Vec3d(-1.0), Vec3d(2.0)}}, Shape{Sphere{Vec3d(0.5), kOuter}}};
    options.solids[1].shape.kind = shell;
    for (Solid& solid : options.solids) solid.wall.kind = WallKind::noSlip;
    Tank tank(
        options, [](const Vec3d&) { return -1.0; }, [](const Vec3d&) { return Vec3d(0.0); });
    tank.setWallVelocity(exact);
    CHECK(tank.apply(1e7).converged);
    errors.push_back(tank.error(exact, everywhere));
  }
  INFO(errors[0] << " " << errors[1] << " " << errors[2]);
  CHECK(errors[1] < 0.6 * errors[0]);
  CHECK(errors[2] < 0.6 * errors[1]);
  CHECK(errors[2] < 0.02);
}

TEST_CASE("applyViscosity: liquid that turns with its walls has no strain", "[sim]") {
  const Field turning = [](const Vec3d& x) { return Vec3d(0.3, 0.5, 1.0).cross(x - Vec3d(0.5)); };
  Options options = tankOf(20);
  options.solids.resize(2);
  options.solids[0].shape.kind = Sphere{Vec3d(0.5), 0.18};
  Difference shell;
  shell.parts = {Shape{Box{Vec3d(-1.0), Vec3d(2.0)}}, Shape{Sphere{Vec3d(0.5), 0.42}}};
  options.solids[1].shape.kind = shell;
  for (Solid& solid : options.solids) solid.wall.kind = WallKind::noSlip;
  Tank tank(
      options, [](const Vec3d&) { return -1.0; }, turning);
  tank.setSolidVelocity(turning);
  CHECK(tank.apply(1e3).converged);
  CHECK(tank.error(turning, everywhere) < 1e-5);
}

TEST_CASE("applyViscosity: converges at any viscosity, with sheets, drops and a wall", "[sim]") {
  Options options = tankOf(40);
  options.walls.push_back({DomainFace::zLow, {.kind = WallKind::noSlip}});
  const Distance shape = [&](const Vec3d& x) {
    double d = x[2] - 0.35 - 0.05 * std::sin(14 * x[0]) * std::cos(17 * x[1]);
    d = std::min(d, (x - Vec3d(0.3, 0.4, 0.8)).length() - 0.02);
    d = std::min(d, (x - Vec3d(0.7, 0.4, 0.8)).length() - 0.06);
    return std::min(d, std::max(std::abs(x[0] - 0.4 - 0.4 * x[2]) - 0.018, std::abs(x[2] - 0.5) - 0.25));
  };
  for (const double number : {1e-2, 1.0, 1e2, 1e4, 1e6, 1e8}) {
    Tank tank(options, shape, mixed);
    const auto report = tank.apply(number);
    CHECK(report.converged);
    CHECK(report.iterations <= 60);
  }
}

TEST_CASE("applyViscosity: a negligible viscosity costs nothing and changes nothing", "[sim]") {
  Tank tank(tankOf(16), dropDistance, mixed);
  const Tank before(tankOf(16), dropDistance, mixed);
  const auto report = tank.apply(0.9e-4);
  CHECK(report.skipped);
  CHECK(report.converged);
  for (int a = 0; a < 3; ++a) {
    for (auto it = tank.velocity.component[a]->cbeginValueOn(); it; ++it)
      REQUIRE(*it == before.velocity.component[a]->tree().getValue(it.getCoord()));
  }
}

TEST_CASE("applyViscosity: variable viscosity bends the profile where it is thin", "[sim]") {
  // Between plates, the lower half four times as viscous: the stress is the same, the slope a quarter.
  const Channel channel(16, 2.0);
  const Field profile = [](const Vec3d& x) {
    const double z = std::clamp(x[2], 0.0, 1.0);
    return Vec3d(z < 0.5 ? 0.4 * z : 0.2 + 1.6 * (z - 0.5), 0.0, 0.0);
  };
  Tank tank(
      channel.options, [](const Vec3d&) { return -1.0; }, [](const Vec3d&) { return Vec3d(0.0); });
  tank.setWallVelocity(profile);
  FloatGrid::Ptr viscosity = tank.phi->deepCopy();
  for (auto it = viscosity->beginValueOn(); it; ++it)
    it.setValue(viscosity->indexToWorld(it.getCoord())[2] < 0.5 ? 4e8f : 1e8f);
  CHECK(applyViscosity(tank.velocity, *tank.phi, tank.solid, 1.0, kDensity, {.variable = viscosity.get()})
            .converged);
  CHECK(tank.error(profile, everywhere) < 0.02);
}

TEST_CASE("applyViscosity: the same bits on any number of threads", "[sim]") {
  Options options = tankOf(32);
  options.walls.push_back({DomainFace::zLow, {.kind = WallKind::noSlip}});
  const Distance pool = [](const Vec3d& x) { return x[2] - 0.4 - 0.1 * std::sin(9 * x[0]); };
  Tank many(options, pool, mixed), one(options, pool, mixed);
  CHECK(many.apply(30.0).converged);
  {
    onThreads(1, [&] { CHECK(one.apply(30.0).converged); });
  }
  for (int a = 0; a < 3; ++a) {
    for (auto it = many.velocity.component[a]->cbeginValueOn(); it; ++it)
      REQUIRE(*it == one.velocity.component[a]->tree().getValue(it.getCoord()));
  }
}
