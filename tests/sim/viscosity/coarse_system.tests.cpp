#include "sim/viscosity/coarse_system.h"

#include "tests/sim/viscosity/drop_system.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <vector>

using namespace fluidtex::sim;

TEST_CASE("coarse system: mass is kept, and each face is a mean of at most eight twice as large", "[sim]") {
  const Tank tank(tankOf(32), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem fine = systemOf(tank, 1.0, before);
  FaceTransfer transfer;
  const ViscousSystem coarse = coarsen(fine, transfer);
  const auto sum = [](const std::vector<float>& mass) {
    return std::accumulate(mass.begin(), mass.end(), 0.0);
  };
  CHECK(sum(coarse.mass) == Approx(sum(fine.mass)).epsilon(1e-4));
  CHECK(coarse.unknowns == coarse.faces);
  CHECK(coarse.unknowns > fine.unknowns / 16);
  CHECK(coarse.unknowns < fine.unknowns / 3);
  REQUIRE(transfer.parent.size() == std::size_t(fine.unknowns));
  int wrong = 0;
  for (std::int32_t f = 0; f < fine.unknowns; ++f) {
    double weights = 0.0;
    for (int n = 0; n < 8; ++n) {
      const float weight = transfer.weight[f][n];
      weights += weight;
      if (weight == 0.0f) continue;
      const std::int32_t parent = transfer.parent[f][n];
      if (parent < 0 || parent >= coarse.unknowns) ++wrong;
      // A face lies at most one and a half cells, three quarters of a coarse one, from its parents.
      for (int a = 0; a < 3; ++a)
        if (std::abs(2 * coarse.coord[parent][a] - fine.coord[f][a]) > 2) ++wrong;
    }
    if (std::abs(weights - 1.0) > 1e-5) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("coarse system: a motion without strain has none, and a shear has the energy that it had",
          "[sim]") {
  const Tank tank(tankOf(32), dropDistance, mixed);
  std::vector<double> before;
  const ViscousSystem fine = systemOf(tank, 1.0, before);
  FaceTransfer transfer;
  const ViscousSystem coarse = coarsen(fine, transfer);
  // u = z in fine cells; faces of u lie at half heights.
  const auto energy = [](const ViscousSystem& system, double cell, double shear) {
    std::vector<double> x(system.faces + 1, 0.0);
    for (std::int32_t f = 0; f < system.start[0].back(); ++f)
      x[f] = 1.0 + shear * cell * (system.coord[f][2] + 0.5);
    double sum = 0.0;
    for (const StrainSample& sample : system.samples) {
      // Beside the drop's surface samples have faces that are no unknowns.
      if (std::any_of(sample.face.begin(), sample.face.end(),
                      [&](std::int32_t f) { return f >= system.unknowns && f != system.nowhere(); }))
        continue;
      const double strain = strainAt(sample, x);
      sum += 0.5 * sample.weight * strain * strain;
    }
    return sum;
  };
  CHECK(energy(coarse, 2.0, 0.0) == 0.0);
  CHECK(energy(coarse, 2.0, 1.0) == Approx(energy(fine, 1.0, 1.0)).epsilon(0.3));
}
