#include "sim/pressure/liquid_cells.h"

#include "tests/sim/pressure/pressure_scene.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

LiquidCells gathered(const Scene& scene) {
  const auto& c = scene.velocity.component;
  return gatherLiquid(*scene.phi, *scene.solid, {&c[0]->constTree(), &c[1]->constTree(), &c[2]->constTree()});
}

}  // namespace

TEST_CASE("liquid cells: those below the surface, with what lies on their sides", "[sim]") {
  // Water 3.3 cells deep: its highest centres lie 0.8 cells below the surface.
  const Scene scene(8, {}, [](const Vec3d& x) { return x[2] - 3.3 / 8; });
  const LiquidCells liquid = gathered(scene);
  REQUIRE(liquid.numbering.size() == 8 * 8 * 3);
  const LiquidSides& top = liquid.sidesOf(liquid.numbering.at(Coord(4, 4, 2)));
  CHECK_THAT(top.theta[5], WithinAbs(0.8, 1e-5));
  CHECK(top.theta[4] == 0.0f);
  CHECK(top.open == kAllLiquid.open);
  CHECK(liquid.sidesOf(liquid.numbering.at(Coord(4, 4, 1))) == kAllLiquid);
  const LiquidSides& corner = liquid.sidesOf(liquid.numbering.at(Coord(0, 7, 0)));
  CHECK(corner.open == std::array<float, kSides>{0.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f});
  CHECK(liquid.numbering.at(Coord(4, 4, 3)) == -1);
  CHECK(liquid.edges.empty());
}

TEST_CASE("liquid cells: the outflow is the sum over open faces, walls let none through", "[sim]") {
  Scene scene(8, {}, [](const Vec3d& x) { return x[2] - 3.3 / 8; });
  scene.setVelocity([](const Vec3d& x) { return Vec3d(2.0 * x[0], 0.0, 1.0); });
  const LiquidCells liquid = gathered(scene);
  // In the middle the difference of two faces; beside the floor one face only.
  CHECK_THAT(liquid.outflow[liquid.numbering.at(Coord(4, 4, 1))], WithinAbs(2.0 / 8, 1e-6));
  CHECK_THAT(liquid.outflow[liquid.numbering.at(Coord(4, 4, 0))], WithinAbs(2.0 / 8 + 1.0, 1e-6));
}

TEST_CASE("liquid cells: faces on an open side are edges, with the velocity out of it", "[sim]") {
  Options options;
  options.resolution = 8;
  options.sides[0] = Side::open;  // low x
  Scene scene(8, {}, [](const Vec3d& x) { return x[2] - 3.3 / 8; });
  scene.solid = Solids(options).at(0.0);
  CHECK(endsAt(Side::open, *scene.solid, Coord(0, 3, 1), 0));
  CHECK_FALSE(endsAt(Side::open, *scene.solid, Coord(1, 3, 1), 0));
  CHECK_FALSE(endsAt(Side::open, *scene.solid, Coord(7, 3, 1), 1));
  for (const double speed : {-1.0, 1.0}) {
    scene.setVelocity([&](const Vec3d&) { return Vec3d(speed, 0.0, 0.0); });
    const LiquidCells liquid = gathered(scene);
    REQUIRE(liquid.edges.size() == 8 * 3);
    for (const Edge& edge : liquid.edges) {
      CHECK(liquid.numbering.cell(edge.cell)[0] == 0);
      CHECK(edge.side == 0);
      CHECK_FALSE(edge.shut);
      CHECK_THAT(edge.outward, WithinAbs(-speed, 1e-6));
    }
  }
}

TEST_CASE("liquid cells: sides lead to the six neighbours", "[sim]") {
  CHECK(neighborOf(Coord(1, 2, 3), 0) == Coord(0, 2, 3));
  CHECK(neighborOf(Coord(1, 2, 3), 3) == Coord(1, 3, 3));
  for (int side = 0; side < kSides; ++side)
    CHECK(neighborOf(neighborOf(Coord(1, 2, 3), side), side ^ 1) == Coord(1, 2, 3));
}
