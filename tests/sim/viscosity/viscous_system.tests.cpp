#include "sim/viscosity/viscous_system.h"

#include "sim/surface/level_set.h"
#include "tests/sim/viscosity/drop_system.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

int componentOf(const ViscousSystem& system, std::int32_t unknown) {
  return unknown < system.start[0].back() ? 0 : (unknown < system.start[1].back() ? 1 : 2);
}

}  // namespace

TEST_CASE("viscous system: unknowns come first, and each number leads to its face and back", "[sim]") {
  const Tank tank(tankOf(24), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, 1.0, before);
  REQUIRE(system.unknowns > 1000);
  REQUIRE(before.size() == std::size_t(system.faces) + 1);
  CHECK(before.back() == 0.0);
  int numbered = 0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < system.table.voxels(); ++v) {
      const std::int32_t n = system.number[c][v];
      if (n < 0) continue;
      ++numbered;
      REQUIRE(system.coord[n] == system.table.coord(std::int64_t(v)));
      REQUIRE(before[n] == double(tank.velocity[c].tree().getValue(system.coord[n])));
      if (n >= system.unknowns) continue;
      REQUIRE(componentOf(system, n) == c);
      Coord below = system.coord[n];
      --below[c];
      const auto& phi = tank.phi->tree();
      REQUIRE((phi.getValue(system.coord[n]) < 0.0f || phi.getValue(below) < 0.0f));
    }
  }
  CHECK(numbered == system.faces);
}

TEST_CASE("viscous system: each unknown knows the samples that hold it, and their slopes", "[sim]") {
  const Tank tank(tankOf(24), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, 1.0, before);
  int links = 0;
  for (std::int32_t s = 0; s < std::int32_t(system.samples.size()); ++s) {
    const StrainSample& sample = system.samples[s];
    const float slope[4] = {-sample.a, sample.a, -sample.b, sample.b};
    for (int n = 0; n < 4; ++n) {
      const std::int32_t face = sample.face[n];
      if (face >= system.unknowns) continue;
      int found = 0;
      for (int slot = 0; slot < 6; ++slot) {
        if (system.samplesOf[face][slot] != s) continue;
        ++found;
        REQUIRE(strainOf(sample, componentOf(system, face), slot) == slope[n]);
      }
      REQUIRE(found == 1);
      ++links;
    }
  }
  int listed = 0;
  for (const FaceSamples& samples : system.samplesOf)
    for (const std::int32_t s : samples) listed += s < std::int32_t(system.samples.size());
  CHECK(listed == links);
}

TEST_CASE("viscous system: the masses of each component are the liquid's volume", "[sim]") {
  // A ball, and a disc of two cells.
  for (const bool disc : {false, true}) {
    const auto level = [&](const Vec3d& x) {
      return disc ? std::max(std::abs(x[2] - 0.5) - 1.0 / 24, std::hypot(x[0] - 0.5, x[1] - 0.5) - 0.35)
                  : dropDistance(x);
    };
    const Tank tank(tankOf(24), level, mixed);
    std::vector<double> before;
    const ViscousSystem system = systemOf(tank, 1.0, before);
    double mass[3] = {};
    for (std::int32_t i = 0; i < system.unknowns; ++i) mass[componentOf(system, i)] += system.mass[i];
    const double cells = liquidVolume(*tank.phi, tank.solid) / std::pow(tank.h, 3);
    CAPTURE(disc, cells);
    for (const double m : mass) CHECK(m == Approx(cells).epsilon(0.03));
  }
}

TEST_CASE("viscous system: a drop's rigid motion has no strain", "[sim]") {
  const Vec3d spin(0.3, -1.0, 2.0);
  const Tank tank(tankOf(24), dropDistance,
                  [&](const Vec3d& x) { return Vec3d(0.1, 0.2, 0.3) + spin.cross(x); });
  std::vector<double> before;
  const ViscousSystem system = systemOf(tank, 1.0, before);
  double worst = 0.0;
  for (const StrainSample& s : system.samples)
    worst = std::max(worst, std::abs(strainAt(s, before) + s.offset));
  CHECK(worst < 1e-5);
}
