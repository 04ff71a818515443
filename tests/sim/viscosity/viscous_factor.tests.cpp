#include "sim/viscosity/viscous_factor.h"

#include "tests/sim/viscosity/drop_system.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("viscous factor: solves for its faces while all others are 0", "[sim]") {
  const Tank tank(tankOf(16), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, 10.0, before);
  std::vector<std::int32_t> some;
  for (std::int32_t i = 0; i < system.unknowns; ++i)
    if (i % 3 != 1) some.push_back(i);
  const ViscousFactor factor(system, some);
  REQUIRE(factor.good());
  CHECK(factor.faces() == some);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> x(system.faces + 1, 0.0), b(some.size());
  for (const std::int32_t i : some) x[i] = uniform(random);
  const std::vector<double> y = multiplied(system, x);
  for (std::size_t n = 0; n < some.size(); ++n) b[n] = y[some[n]];
  factor.solve(b);
  for (std::size_t n = 0; n < some.size(); ++n) REQUIRE_THAT(b[n], WithinAbs(x[some[n]], 1e-4));
}

TEST_CASE("viscous factor: films and threads are thin, a ball is not", "[sim]") {
  const auto thinShare = [](const std::function<double(const Vec3d&)>& level) {
    const Tank tank(tankOf(24), level, mixed);
    std::vector<double> before;
    const ViscousSystem system = systemOf(tank, 1.0, before);
    return double(facesOfThinParts(system).size()) / system.unknowns;
  };
  const double h = 1.0 / 24;
  CHECK(thinShare([&](const Vec3d& x) { return std::abs(x[2] - 0.5) - 0.9 * h; }) == 1.0);
  CHECK(thinShare([&](const Vec3d& x) { return std::hypot(x[0] - 0.5, x[1] - 0.5) - 0.9 * h; }) == 1.0);
  CHECK(thinShare([](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.4; }) < 0.3);
  CHECK(thinShare([](const Vec3d&) { return -1.0; }) == 0.0);
}
