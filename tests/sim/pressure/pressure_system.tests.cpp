#include "sim/pressure/pressure_system.h"

#include "tests/sim/pressure/pressure_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

LiquidCells poolCells() {
  const Scene scene(8, {}, [](const Vec3d& x) { return x[2] - 3.3 / 8; });
  const auto& c = scene.velocity.component;
  return gatherLiquid(*scene.phi, *scene.solid, {&c[0]->constTree(), &c[1]->constTree(), &c[2]->constTree()});
}

}  // namespace

TEST_CASE("pressure system: links are open areas, the surface is an anchor of one over its distance",
          "[sim]") {
  const LiquidCells liquid = poolCells();
  std::vector<int> liquidOf;
  const PoissonSystem system =
      pressureSystem(liquid, std::vector<char>(liquid.numbering.size(), 0), liquidOf);
  REQUIRE(system.numbering.size() == liquid.numbering.size());
  for (int i = 0; i < system.numbering.size(); ++i) {
    const Coord cell = system.numbering.cell(i);
    REQUIRE(liquid.numbering.cell(liquidOf[i]) == cell);
    REQUIRE_THAT(system.anchor[i], WithinAbs(cell[2] == 2 ? 1.0 / 0.8 : 0.0, 1e-5));
    REQUIRE(system.anchoredSides[i] == (cell[2] == 2 ? 1 << 5 : 0));
    for (int s = 0; s < kSides; ++s) {
      const int neighbor = system.numbering.at(neighborOf(cell, s));
      REQUIRE(system.rows.link[i][s] == (neighbor < 0 ? 0.0f : 1.0f));
      if (neighbor >= 0) REQUIRE(system.rows.neighbor[i][s] == neighbor);
    }
  }
}

TEST_CASE("pressure system: a detached cell is no unknown, and its neighbours' anchor at its centre",
          "[sim]") {
  const LiquidCells liquid = poolCells();
  std::vector<char> detached(liquid.numbering.size(), 0);
  const Coord gone(4, 4, 0);
  detached[liquid.numbering.at(gone)] = 1;
  std::vector<int> liquidOf;
  const PoissonSystem system = pressureSystem(liquid, detached, liquidOf);
  CHECK(system.numbering.size() == liquid.numbering.size() - 1);
  CHECK(system.numbering.at(gone) == -1);
  const int beside = system.numbering.at(Coord(5, 4, 0));
  CHECK_THAT(system.anchor[beside], WithinAbs(1.0, 1e-6));
  CHECK(system.rows.link[beside][0] == 0.0f);
}
