#include "sim/pressure/pressure.h"

#include "sim/grid/mac_grid.h"
#include "tests/sim/pressure/pressure_scene.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <functional>
#include <numbers>
#include <random>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

PressureOptions precise() {
  PressureOptions options;
  options.tolerance = 1e-11;
  return options;
}

}  // namespace

TEST_CASE("pressure: a column at rest stays at rest, whatever the height of its surface", "[sim]") {
  const int n = 16;
  const double share = GENERATE(0.0, 0.003, 0.1, 0.37, 0.5, 0.63, 0.999);
  const double surface = (9 + share) / n;
  CAPTURE(share);
  Scene scene(n, {}, [&](const Vec3d& x) { return x.z() - surface; });
  const Projection result = scene.projected(precise());
  CHECK(scene.largestSpeed(result.valid) < 1e-6 * kStep);
  CHECK(result.separating->empty());
  // Linear in depth; the surface is where phi says, but for the smallest theta.
  for (auto it = result.pressure->cbeginValueOn(); it; ++it) {
    const double depth = surface - result.pressure->indexToWorld(it.getCoord()).z();
    REQUIRE_THAT(*it, WithinAbs(kDensity * kGravity * depth, kDensity * kGravity * 0.0101 / n));
  }
  CHECK(result.report.cells == n * n * (share > 0.5 ? 10 : 9));
}

TEST_CASE("pressure: a column at rest stays at rest at the default tolerance", "[sim]") {
  Scene scene(32, {}, [](const Vec3d& x) { return x.z() - 0.53; });
  const Projection result = scene.projected();
  CHECK(scene.largestSpeed(result.valid) < 1e-4 * kStep);
}

TEST_CASE("pressure: hydrostatic liquid on tilted walls and around a sphere stays at rest", "[sim]") {
  const double angle = 20.0 * std::numbers::pi / 180.0;
  Scene scene(24,
              {Shape{HalfSpace{Vec3d(0.0, 0.0, 0.15), Vec3d(-std::sin(angle), 0.0, std::cos(angle))}},
               Shape{Sphere{Vec3d(0.3, 0.4, 0.45), 0.13}}},
              [](const Vec3d& x) { return x.z() - 0.617; });
  const Projection result = scene.projected(precise());
  CHECK(scene.largestSpeed(result.valid) < 1e-6 * kStep);
  CHECK(result.separating->empty());
}

TEST_CASE("pressure: a drop in the air falls as it is", "[sim]") {
  Scene scene(24, {}, [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.23; });
  const Projection result = scene.projected(precise());
  for (auto it = result.valid.component[2]->cbeginValueOn(); it; ++it) {
    REQUIRE_THAT(scene.velocity.component[2]->tree().getValue(it.getCoord()), WithinRel(-kStep, 1e-6));
  }
  CHECK(result.valid.component[2]->activeVoxelCount() > 500);
  CHECK(result.separating->empty());
}

TEST_CASE("pressure: no divergence is left in any cell, cut or whole", "[sim]") {
  Scene scene(
      24, {Shape{Sphere{Vec3d(0.5, 0.5, 0.2), 0.21}}, Shape{HalfSpace{Vec3d(0.1, 0, 0), Vec3d(2, 1, 0.5)}}},
      [](const Vec3d& x) { return x.z() - 0.6 - 0.1 * std::sin(9 * x.x()) * std::cos(7 * x.y()); });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  scene.setVelocity([&](const Vec3d&) { return Vec3d(uniform(random), uniform(random), uniform(random)); });
  PressureOptions options = precise();
  SECTION("liquid that may not separate") {
    options.maxSeparationPasses = 0;
    const Projection result = scene.projected(options);
    CHECK(result.separating->empty());
    CHECK(scene.largestDivergence(*result.separating) < 2e-6);
  }
  SECTION("liquid that may: only where it does, and nowhere does it pile up") {
    options.maxSeparationPasses = 20;
    const Projection result = scene.projected(options);
    CHECK(result.report.separationPasses < 20);
    CHECK(result.separating->activeVoxelCount() > 0);
    CHECK(scene.largestDivergence(*result.separating) < 2e-6);
    double lowest = 0.0;
    for (auto it = result.pressure->cbeginValueOn(); it; ++it) {
      const Coord c = it.getCoord();
      bool atSolid = false;
      for (int a = 0; a < 3; ++a) {
        Coord up = c;
        ++up[a];
        atSolid = atSolid || scene.open(a, c) < 1.0f || scene.open(a, up) < 1.0f;
      }
      if (atSolid) lowest = std::min(lowest, *it);
    }
    CHECK(lowest > -0.01 * kDensity / kDt / 24);  // no suction at solids, but for rounding
  }
}

TEST_CASE("pressure: projecting twice changes nothing more", "[sim]") {
  Scene scene(16, {}, [](const Vec3d& x) { return x.z() - 0.55 - 0.2 * x.x(); });
  scene.projected(precise());
  const FloatGrid::Ptr once = scene.velocity.component[2]->deepCopy();
  scene.projected(precise());
  for (auto it = once->cbeginValueOn(); it; ++it) {
    REQUIRE_THAT(scene.velocity.component[2]->tree().getValue(it.getCoord()), WithinAbs(*it, 1e-6 * kStep));
  }
}

TEST_CASE("pressure: liquid under a ceiling comes off and falls", "[sim]") {
  const int n = 16;
  Scene scene(n, {}, [](const Vec3d& x) { return 0.69 - x.z(); });
  PressureOptions options = precise();
  options.suction = 0.1 * kDensity * kGravity / n;
  const Projection result = scene.projected(options);
  CHECK(result.separating->activeVoxelCount() > 0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 11; k <= n; ++k) {
        const Coord c(i, j, k);
        REQUIRE(result.valid.component[2]->tree().isValueOn(c));
        REQUIRE_THAT(scene.velocity.component[2]->tree().getValue(c), WithinRel(-kStep, 1e-6));
      }
    }
  }
  options.maxSeparationPasses = 0;
  scene.setVelocity([](const Vec3d&) { return Vec3d(0.0, 0.0, -kStep); });
  const Projection glued = scene.projected(options);
  CHECK(glued.separating->empty());
  CHECK(scene.largestSpeed(glued.valid) < 1e-6 * kStep);  // else it hangs there
}

TEST_CASE("pressure: liquid thrown at a wall turns, liquid pulled off it leaves", "[sim]") {
  const int n = 16;
  const double sign = GENERATE(-1.0, 1.0);
  Scene scene(n, {}, [](const Vec3d& x) { return x.x() - 0.5; });  // a block against the wall x = 0
  scene.setVelocity([&](const Vec3d&) { return Vec3d(sign, 0.0, 0.0); });
  const Projection result = scene.projected(precise());
  const float atWall = scene.velocity.component[0]->tree().getValue(Coord(0, 8, 8));
  CHECK(result.valid.component[0]->tree().isValueOn(Coord(0, 8, 8)));
  if (sign < 0.0) {
    CHECK(atWall == 0.0f);
    CHECK(result.separating->empty());
  } else {
    CHECK_THAT(atWall, WithinRel(1.0, 1e-5));  // the whole block, unhindered
    CHECK_THAT(scene.velocity.component[0]->tree().getValue(Coord(5, 8, 8)), WithinRel(1.0, 1e-5));
  }
}

TEST_CASE("pressure: a pocket without surface is solved, beside liquid that has one", "[sim]") {
  const int n = 20;
  // A full chamber for x < 0.4 behind a wall; a tank half full beyond it.
  Scene scene(n, {Shape{Box{Vec3d(0.4, -1.0, -1.0), Vec3d(0.5, 2.0, 2.0)}}},
              [](const Vec3d& x) { return x.x() < 0.45 ? -0.2 : x.z() - 0.5; });
  scene.setVelocity([](const Vec3d& x) { return Vec3d(std::sin(5 * x.y()), std::cos(4 * x.x()), -kStep); });
  PressureOptions options = precise();
  options.maxSeparationPasses = 0;
  const Projection result = scene.projected(options);
  CHECK(scene.largestDivergence(*result.separating) < 2e-6);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) sum += result.pressure->tree().getValue(Coord(i, j, k));
    }
  }
  CHECK_THAT(sum / (8 * n * n), WithinAbs(0.0, 1e-6));  // the free constant: mean 0

  // Full and closed, it cannot separate from anything: gravity alone leaves it still.
  scene.setVelocity([](const Vec3d&) { return Vec3d(0.0, 0.0, -kStep); });
  const Projection still = scene.projected(precise());
  CHECK(still.separating->empty());
  CHECK(scene.largestSpeed(still.valid) < 1e-6 * kStep);
}

TEST_CASE("pressure: single cells by hand", "[sim]") {
  // One liquid cell in the air, divergence d: every theta is 1/2, so 6 q / (1/2) = -d and each face moves by
  // d / 6.
  Scene scene(8, {}, [](const Vec3d& x) { return (x - Vec3d(0.4375)).length() - 0.0625; });
  scene.setVelocity([](const Vec3d&) { return Vec3d(0.0); });
  FloatGrid& u = *scene.velocity.component[0];
  u.tree().setValueOn(Coord(4, 3, 3), 0.6f);
  const Projection result = scene.projected(precise());
  CHECK(result.report.cells == 1);
  CHECK_THAT(u.tree().getValue(Coord(4, 3, 3)), WithinAbs(0.5, 1e-6));
  CHECK_THAT(u.tree().getValue(Coord(3, 3, 3)), WithinAbs(0.1, 1e-6));
  CHECK_THAT(scene.velocity.component[2]->tree().getValue(Coord(3, 3, 3)), WithinAbs(0.1, 1e-6));
  CHECK_THAT(scene.velocity.component[2]->tree().getValue(Coord(3, 3, 4)), WithinAbs(-0.1, 1e-6));
  const double pascal = kDensity * scene.h / kDt;
  CHECK_THAT(result.pressure->tree().getValue(Coord(3, 3, 3)), WithinRel(-0.6 / 12.0 * pascal, 1e-6));
  CHECK(u.tree().getValue(Coord(5, 3, 3)) == 0.0f);
  CHECK(result.valid.component[0]->activeVoxelCount() == 2);
}

TEST_CASE("pressure: a face that a solid leaves open by a hair is no nozzle", "[sim]") {
  // One liquid cell as above between two open faces: 0.6 = (1 + share) q / (1/2).
  const float share = GENERATE(0.05f, 0.2f);
  CAPTURE(share);
  Scene scene(8, {}, [](const Vec3d& x) { return (x - Vec3d(0.4375)).length() - 0.0625; });
  SolidField narrow = *scene.solid;
  for (FloatGrid::Ptr& open : narrow.open.component) open = open->deepCopy();
  const Coord cell(3, 3, 3), behind(4, 3, 3);
  narrow.open.component[0]->tree().setValue(behind, share);
  for (const FloatGrid::Ptr& open : {narrow.open.component[1], narrow.open.component[2]}) {
    open->tree().setValue(cell, 0.0f);
    open->tree().setValue(open == narrow.open.component[1] ? Coord(3, 4, 3) : Coord(3, 3, 4), 0.0f);
  }
  scene.solid = std::make_shared<const SolidField>(narrow);
  scene.setVelocity([](const Vec3d&) { return Vec3d(0.0); });
  FloatGrid& u = *scene.velocity.component[0];
  u.tree().setValueOn(cell, 0.6f);
  const Projection result = scene.projected(precise());
  const double q = 0.3 / (1.0 + share);
  CHECK_THAT(u.tree().getValue(cell), WithinAbs(0.6 - 2.0 * q, 1e-6));
  const bool wide = share > 0.1f;
  CHECK(result.valid.component[0]->tree().isValueOn(behind) == wide);
  CHECK_THAT(u.tree().getValue(behind), WithinAbs(wide ? 2.0 * q : 0.0, 1e-6));
}

TEST_CASE("pressure: the expansion has the divergence asked for, and leaves the velocity as it is", "[sim]") {
  // A ball in the floor, one of air in the tank's liquid.
  const auto level = [](const Vec3d& x) {
    return std::max(x[2] - 0.6, 0.15 - (x - Vec3d(0.5, 0.5, 0.4)).length());
  };
  Scene scene(24, {Shape{Sphere{Vec3d(0.3, 0.4, 0.0), 0.2}}}, level), grown = scene;
  grown.velocity = copyOf(scene.velocity);
  PressureOptions options = precise();
  const Projection without = scene.projected(options);
  CHECK(without.expansion.component[0] == nullptr);
  options.divergence = FloatGrid::create(0.0f);
  const double volume = std::pow(scene.h, 3);
  double sum = 0.0;
  for (const auto& [cell, rate] : {std::pair(Coord(12, 12, 2), 3.0f), {Coord(20, 20, 10), 1.0f}}) {
    options.divergence->tree().setValueOn(cell, rate);
    sum += rate * volume;
  }
  const Projection with = grown.projected(options);
  double outflow = 0.0, largest = 0.0;
  for (int a = 0; a < 3; ++a) {
    auto other = grown.velocity.component[a]->tree().cbeginLeaf();
    for (auto leaf = scene.velocity.component[a]->tree().cbeginLeaf(); leaf; ++leaf, ++other)
      CHECK(std::memcmp(leaf->buffer().data(), other->buffer().data(), sizeof(float) * 512) == 0);
  }
  for (auto it = grown.phi->cbeginValueOn(); it; ++it) {
    if (*it >= 0.0f) continue;
    const Coord c = it.getCoord();
    double out = 0.0;
    for (int a = 0; a < 3; ++a) {
      Coord up = c;
      ++up[a];
      const auto& speed = with.expansion.component[a]->tree();
      out += grown.open(a, up) * speed.getValue(up) - grown.open(a, c) * speed.getValue(c);
    }
    out *= grown.h * grown.h;
    outflow += out;
    largest = std::max(largest, std::abs(out - options.divergence->tree().getValue(c) * volume));
  }
  CHECK_THAT(outflow, WithinRel(sum, 0.02));
  CHECK(largest < 0.02 * sum);
}

TEST_CASE("pressure: no liquid is no fault", "[sim]") {
  Scene scene(8, {}, [](const Vec3d&) { return 1.0; });
  const Projection result = scene.projected();
  CHECK(result.report.cells == 0);
  CHECK(result.valid.component[0]->empty());
}

TEST_CASE("pressure: second order around a ball, from cut cells to the surface", "[sim]") {
  // A shell of liquid around a ball of radius a, its surface at r = R. The velocity is the gradient of
  // f = (R^2 - r^2) (r^2 - a^2)^2, which is 0 on the surface and has no slope on the ball: the pressure that
  // takes it all away is p = f density / dt.
  const double a = 0.2, radius = 0.43;
  const Vec3d centre(0.503, 0.497, 0.491);
  const auto f = [&](double r) { return (radius * radius - r * r) * std::pow(r * r - a * a, 2); };
  const auto slope = [&](double r) {
    const double s = r * r - a * a;
    return -2 * r * s * s + (radius * radius - r * r) * 4 * r * s;
  };
  const auto errorAt = [&](int n) {
    Scene scene(n, {Shape{Sphere{centre, a}}},
                [&](const Vec3d& x) { return (x - centre).length() - radius; });
    scene.setVelocity([&](const Vec3d& x) {
      const Vec3d d = x - centre;
      const double r = d.length();
      return slope(r) / r * d;
    });
    PressureOptions options = precise();
    options.maxSeparationPasses = 0;
    const Projection result = scene.projected(options);
    double worst = 0.0;
    const double unit = kDensity / kDt;  // p = f density / dt
    for (auto it = result.pressure->cbeginValueOn(); it; ++it) {
      const double r = (result.pressure->indexToWorld(it.getCoord()) - centre).length();
      if (r < a) continue;
      worst = std::max(worst, std::abs(*it / unit - f(r)));
    }
    return worst;
  };
  const double coarse = errorAt(16), fine = errorAt(32), finest = errorAt(64);
  CAPTURE(coarse, fine, finest, std::log2(coarse / fine), std::log2(fine / finest));
  CHECK(std::log2(coarse / finest) / 2.0 > 1.7);
}

TEST_CASE("pressure: the same bytes on any number of threads", "[sim]") {
  const auto run = [](int threads) {
    return onThreads(threads, [&] {
      Scene scene(32, {Shape{Sphere{Vec3d(0.5, 0.5, 0.2), 0.21}}}, [](const Vec3d& x) {
        return x.z() - 0.6 - 0.1 * std::sin(9 * x.x()) * std::cos(7 * x.y());
      });
      scene.setVelocity([](const Vec3d& x) {
        return Vec3d(std::sin(31 * x.y()), std::cos(27 * x.z()), std::sin(20 * x.x() * x.y()));
      });
      const Projection result = scene.projected();
      std::vector<float> bytes;
      for (const auto& grid : scene.velocity.component) {
        for (auto it = grid->cbeginValueOn(); it; ++it) bytes.push_back(*it);
      }
      bytes.push_back(static_cast<float>(result.report.iterations));
      return bytes;
    });
  };
  const auto one = run(1), four = run(4);
  REQUIRE(one.size() == four.size());
  CHECK(std::memcmp(one.data(), four.data(), one.size() * sizeof(float)) == 0);
}

TEST_CASE("pressure: iterations hardly grow with the grid", "[sim]") {
  const auto iterationsAt = [](int n) {
    Scene scene(n, {}, [](const Vec3d& x) { return x.z() - 0.5 - 0.2 * std::sin(5 * x.x()); });
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    scene.setVelocity([&](const Vec3d&) { return Vec3d(uniform(random), uniform(random), uniform(random)); });
    PressureOptions options;
    options.maxSeparationPasses = 0;
    return scene.projected(options).report.iterations;
  };
  const int small = iterationsAt(16), large = iterationsAt(64);
  CAPTURE(small, large);
  CHECK(large <= 16);
  CHECK(large <= small + 6);
}
