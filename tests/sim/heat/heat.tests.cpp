#include "sim/heat/heat.h"

#include "sim/step/solver.h"
#include "sim/step/state_io.h"
#include "tests/sim/heat/pool.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kDensity = 2000.0;

}  // namespace

TEST_CASE("viscosityAt: goes through its table, its logarithm linear between", "[sim]") {
  ViscosityLaw law;
  law.kind = ViscosityLaw::Kind::table;
  law.points = {{1000.0, 1e5}, {1200.0, 1e3}, {1400.0, 10.0}};
  for (const ViscosityPoint& point : law.points)
    CHECK_THAT(viscosityAt(law, 7.0, point.temperature), WithinRel(point.viscosity, 1e-12));
  CHECK_THAT(viscosityAt(law, 7.0, 1100.0), WithinRel(1e4, 1e-12));
  CHECK_THAT(viscosityAt(law, 7.0, 1350.0), WithinRel(10.0 * std::sqrt(10.0), 1e-12));
  CHECK(viscosityAt(law, 7.0, 500.0) == 1e5);
  CHECK(viscosityAt(law, 7.0, 2000.0) == 10.0);
  law.solidus = 800.0;
  CHECK(viscosityAt(law, 7.0, 500.0) == law.solidViscosity);
}

TEST_CASE("viscosityAt: follows its law, up to the solid's", "[sim]") {
  ViscosityLaw law{.kind = ViscosityLaw::Kind::exponential, .reference = 1400.0, .slope = 0.05};
  CHECK_THAT(viscosityAt(law, 100.0, 1400.0), WithinRel(100.0, 1e-12));
  CHECK_THAT(viscosityAt(law, 100.0, 1380.0), WithinRel(100.0 * std::exp(1.0), 1e-12));
  CHECK(viscosityAt(law, 100.0, 300.0) == law.solidViscosity);
  law = {.kind = ViscosityLaw::Kind::arrhenius, .reference = 1000.0, .activationEnergy = 8314.46261815324};
  CHECK_THAT(viscosityAt(law, 2.0, 500.0), WithinRel(2.0 * std::exp(1.0), 1e-9));
  law = {.solidus = 900.0, .solidViscosity = 5e4};
  CHECK(viscosityAt(law, 2.0, 901.0) == 2.0);
  CHECK(viscosityAt(law, 2.0, 899.0) == 5e4);
}

TEST_CASE("conductHeat: a cosine fades at the rate of its wave length", "[sim]") {
  const auto wave = [](const Vec3d& x) { return 1000.0 + 100.0 * std::cos(2.0 * M_PI * x[0]); };
  Pool pool(32, 2.0, wave);
  HeatOptions heat;
  heat.capacity = 1000.0;
  heat.conductivity = 2e4;
  const double time = 1.0, diffusivity = heat.conductivity / (kDensity * heat.capacity);
  for (int n = 0; n < 20; ++n)
    REQUIRE(conductHeat(*pool.temperature, *pool.phi, pool.solid, time / 20, kDensity, heat));
  const double kept = std::exp(-4.0 * M_PI * M_PI * diffusivity * time);
  const double before = wave(Vec3d(0.5 * pool.h, 0.5, 0.5)) - 1000.0;
  CHECK_THAT(pool.at(0, 5, 20) - 1000.0, WithinRel(kept * before, 0.02));
}

TEST_CASE("conductHeat: a well-stirred pool radiates as Stefan and Boltzmann say", "[sim]") {
  constexpr double kLevel = 0.5, kSigma = 5.670374419e-8;
  // d(T^-3)/dt = 3 sigma / (depth density capacity), without surroundings and with a temperature even in
  // depth.
  HeatOptions heat;
  heat.capacity = 1000.0;
  heat.conductivity = 1e9;
  heat.emissivity = 0.9;
  heat.ambient = 0.0;
  Pool pool(16, kLevel, [](const Vec3d&) { return 1500.0; });
  const double time = 4e5;
  constexpr int kSteps = 200;
  for (int n = 0; n < kSteps; ++n)
    REQUIRE(conductHeat(*pool.temperature, *pool.phi, pool.solid, time / kSteps, kDensity, heat));
  const double rate = 3.0 * heat.emissivity * kSigma / (kLevel * kDensity * heat.capacity);
  CHECK_THAT(pool.at(7, 7, 3), WithinRel(std::pow(std::pow(1500.0, -3.0) + rate * time, -1.0 / 3.0), 0.01));
  // However long a step, nothing gets colder than what is around.
  heat.ambient = 400.0;
  for (int n = 0; n < 60; ++n) {
    REQUIRE(conductHeat(*pool.temperature, *pool.phi, pool.solid, 1e12, kDensity, heat));
    REQUIRE(pool.at(7, 7, 3) > 399.9);
  }
  CHECK_THAT(pool.at(7, 7, 3), WithinAbs(400.0, 1.0));
}

TEST_CASE("conductHeat: hot surroundings heat a cold surface as Stefan and Boltzmann say", "[sim]") {
  constexpr double kLevel = 0.5, kSigma = 5.670374419e-8, kAmbient = 1500.0;
  HeatOptions heat;
  heat.capacity = 1000.0;
  heat.conductivity = 1e9;
  heat.emissivity = 0.9;
  heat.ambient = kAmbient;
  Pool pool(16, kLevel, [](const Vec3d&) { return 300.0; });
  // dT/dt = rate (ambient^4 - T^4): the time from 0 to T is the integral of its inverse.
  const double rate = heat.emissivity * kSigma / (kLevel * kDensity * heat.capacity);
  const auto timeTo = [&](double t) {
    return (std::log((kAmbient + t) / (kAmbient - t)) + 2.0 * std::atan(t / kAmbient)) /
           (4.0 * rate * std::pow(kAmbient, 3));
  };
  const double time = timeTo(1200.0) - timeTo(300.0);
  constexpr int kSteps = 200;
  for (int n = 0; n < kSteps; ++n)
    REQUIRE(conductHeat(*pool.temperature, *pool.phi, pool.solid, time / kSteps, kDensity, heat));
  CHECK_THAT(pool.at(7, 7, 3), WithinRel(1200.0, 0.01));
}

TEST_CASE("conductHeat: however long a step, nothing leaves the range of what is around", "[sim]") {
  HeatOptions heat;
  heat.capacity = 1000.0;
  heat.emissivity = 1.0;
  heat.wallTransfer = 50.0;
  heat.wallTemperature = 700.0;
  // Alone, with a little conduction and with much; into heat and into cold.
  for (const double conductivity : {0.0, 1.5, 1e6}) {
    for (const double ambient : {1500.0, 0.0}) {
      for (const double dt : {1.0, 1e3, 1e6, 1e12}) {
        heat.conductivity = conductivity;
        heat.ambient = ambient;
        Pool pool(16, 0.53, [](const Vec3d& x) { return x[0] < 0.5 ? 300.0 : 400.0; });
        const double low = std::min(300.0, ambient), high = std::max(700.0, ambient);
        for (int n = 0; n < 3; ++n) {
          REQUIRE(conductHeat(*pool.temperature, *pool.phi, pool.solid, dt, kDensity, heat));
          double coldest = 1e9, hottest = 0.0;
          for (int i = 0; i < 16; ++i) {
            for (int j = 0; j < 16; ++j) {
              for (int k = 0; k < 8; ++k) {
                coldest = std::min(coldest, pool.at(i, j, k));
                hottest = std::max(hottest, pool.at(i, j, k));
              }
            }
          }
          INFO(conductivity << " W/(m K), around " << ambient << " K, " << dt << " s: " << coldest << " to "
                            << hottest);
          REQUIRE(coldest >= low * (1.0 - 1e-6));
          REQUIRE(hottest <= high * (1.0 + 1e-6));
        }
      }
    }
  }
}

TEST_CASE("solver: temperature rides on the liquid, and comes back from a file bit by bit", "[sim]") {
  Options options;
  options.resolution = 16;
  options.viscosity = 50.0;
  options.heat.simulated = true;
  options.heat.emissivity = 0.9;
  options.heat.law = {.kind = ViscosityLaw::Kind::exponential, .reference = 1400.0, .slope = 0.01};
  options.liquid.push_back({.shape = {Box{{0.0, 0.0, 0.0}, {0.5, 1.0, 0.5}}}, .temperature = 1400.0});
  options.liquid.push_back({.shape = {Box{{0.5, 0.0, 0.0}, {1.0, 1.0, 0.3}}}, .temperature = 1100.0});
  Solver solver(options);
  solver.next();
  solver.next();
  const auto file = std::filesystem::temp_directory_path() / "fluidtex_heat_state.vdb";
  writeState(solver.state(), file);
  Solver again(options, readState(file));
  std::filesystem::remove(file);
  const Frame frame = solver.next(), other = again.next();
  const auto t = frame.fields.at("temperature"), s = other.fields.at("temperature");
  double hottest = 0.0, coldest = 1e9;
  for (auto it = t->cbeginValueOn(); it; ++it) {
    REQUIRE(*it == s->tree().getValue(it.getCoord()));
    if (frame.surfacePhi->tree().getValue(it.getCoord()) >= 0.0f) continue;
    hottest = std::max(hottest, static_cast<double>(*it));
    coldest = std::min(coldest, static_cast<double>(*it));
  }
  CHECK(t->activeVoxelCount() == s->activeVoxelCount());
  CHECK_THAT(hottest, WithinRel(1400.0, 1e-3));
  CHECK_THAT(coldest, WithinRel(1100.0, 2e-2));
}
