#include "sim/viscosity/viscous_multigrid.h"

#include "tests/sim/viscosity/drop_system.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("viscous multigrid: symmetric and positive", "[sim]") {
  const Tank tank(tankOf(32), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, GENERATE(0.1, 1e3), before);
  ViscousMultigrid multigrid(system);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<float> a(system.unknowns), b(a), ma(a), mb(a);
  for (float& v : a) v = uniform(random);
  for (float& v : b) v = uniform(random) + 0.5f;
  multigrid.apply(a, ma);
  multigrid.apply(b, mb);
  double ab = 0.0, ba = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += double(a[i]) * mb[i];
    ba += double(b[i]) * ma[i];
    aa += double(a[i]) * ma[i];
    bb += double(b[i]) * mb[i];
  }
  CHECK(aa > 0.0);
  CHECK(bb > 0.0);
  CHECK_THAT(ab, WithinAbs(ba, 1e-3 * std::sqrt(aa * bb)));
}

TEST_CASE("viscous multigrid: where viscosity is small it is nearly the inverse of the mass", "[sim]") {
  const Tank tank(tankOf(24), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, 1e-6, before);
  ViscousMultigrid multigrid(system);
  std::vector<float> b(system.mass), x(b.size());
  multigrid.apply(b, x);
  double sum = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += system.mass[i] * std::abs(x[i] - 1.0f);
    mass += system.mass[i];
  }
  CHECK(sum < 0.02 * mass);
}
