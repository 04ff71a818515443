#include "sim/pressure/tension_pressure.h"

#include "sim/solids/solids.h"
#include "sim/surface/level_set.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace fluidtex::sim;

namespace {

struct Sides {
  LiquidCells liquid;
  SurfacePressure pressure;
  double at(const Coord& cell, int side) const { return pressure.at(liquid.numbering.at(cell), side); }
};

Sides sidesOf(const SolidField& solid, const FloatGrid& phi) {
  const Velocity velocity = makeVelocity(solid.voxelSize, phi.constTree());
  const auto& [u, v, w] = velocity.component;
  Sides sides{gatherLiquid(phi, solid, {&u->constTree(), &v->constTree(), &w->constTree()}), {}};
  sides.pressure = SurfacePressure(sides.liquid, phi, solid, 1.0);
  return sides;
}

}  // namespace

TEST_CASE("surface pressure: a film's middle yields to its outside") {
  // 1.2 cells thick: its inside has no smooth distance.
  const double h = 1.0 / 32;
  const auto film = makePhi(h, 4 * h);
  unite(
      *film, [&](const Vec3d& x) { return std::abs(x[2] - 0.5 - 0.5 * h) - 0.6 * h; }, firstCells(Coord(32)));
  const Sides sides = sidesOf(*Solids(tank(32, {})).at(0.0), *film);
  for (const int side : {4, 5}) CHECK(std::abs(sides.at(Coord(16, 16, 16), side)) < 1e-3);
}

TEST_CASE("surface pressure: where the surface touches a cell's centre it is one for all sides") {
  // Any difference would act over next to no way, and throw the liquid out.
  constexpr int kCells = 16;
  const double h = 1.0 / kCells;
  const auto solid = Solids(tank(kCells, {})).at(0.0);
  std::uint32_t state = 1;
  const auto random = [&] {
    return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / (1 << 24);
  };
  int judged = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto phi = makePhi(h, 4 * h);
    const Coord middle(8);
    for (int n = 0; n < 343; ++n)
      phi->tree().setValue(middle.offsetBy(n / 49 - 3, n / 7 % 7 - 3, n % 7 - 3),
                           static_cast<float>(h) * (1.6f * random() - 0.6f));
    phi->tree().setValue(middle, static_cast<float>(-1e-4 * h));
    const Sides sides = sidesOf(*solid, *phi);
    double low = kForever, high = -kForever;
    for (int side = 0; side < 6; ++side) {
      Coord beside = middle;
      beside[side / 2] += side % 2 == 0 ? -1 : 1;
      const float distance = phi->tree().getValue(beside);
      if (distance < 0.05f * static_cast<float>(h)) continue;
      low = std::min(low, sides.at(middle, side));
      high = std::max(high, sides.at(middle, side));
      ++judged;
    }
    // theta is at most 1e-4 / 0.05, curvatures differ by 2 / h at most.
    if (high > low) CHECK(high - low < 0.004 * 2.0 / h);
  }
  CHECK(judged > 300);
}

TEST_CASE("tension: none without a coefficient, and detached cells have it near their own surface only") {
  const double h = 1.0 / 16;
  const auto solid = Solids(tank(16, {})).at(0.0);
  const auto phi = makePhi(h, 4 * h);
  unite(
      *phi, [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.3; }, firstCells(Coord(16)));
  const LiquidCells liquid = sidesOf(*solid, *phi).liquid;
  const Tension none = tensionOf(liquid, *phi, *solid, 0.0);
  CHECK(none.surface.none());
  CHECK((none.guess.empty() && none.detached.empty()));

  const Tension tension = tensionOf(liquid, *phi, *solid, 1.0);
  REQUIRE(tension.detached.size() == std::size_t(liquid.numbering.size()));
  const int inside = liquid.numbering.at(Coord(8)), beside = liquid.numbering.at(Coord(12, 8, 8));
  CHECK(tension.guess[inside] > 0.0);
  CHECK(tension.detached[inside] == 0.0);
  CHECK(tension.detached[beside] > 0.2 * tension.guess[beside]);
  CHECK(tension.detached[beside] < tension.guess[beside]);
}

TEST_CASE("tension: a cell is anchored by the open area of its surface over the distance to it") {
  LiquidSides cell = kAllLiquid;
  CHECK(anchoredBy(cell) == 1.0);
  cell.open[3] = 0.5f;
  cell.theta[3] = 0.25f;
  CHECK(anchoredBy(cell) == 3.0);
}

TEST_CASE("surface pressure: drops and jets that separate from walls are not thrown out", "[slow]") {
  // A splash of drops of a few cells around a ball, which surface tension alone could set moving at no more
  // than sqrt(4 tension / (density h)) = 1.2 m/s.
  Options options;
  options.size = Vec3d(0.130769, 0.107692, 0.2);
  options.resolution = 26;
  options.frameRate = 54.0;
  options.density = 1645.25;
  options.viscosity = 0.105404;
  options.surfaceTension = 4.2574;
  options.sources.resize(1);
  options.sources[0].shape = {Sphere{Vec3d(0.0717822, 0.042985, 0.129325), 0.0121131}};
  options.sources[0].velocity = Vec3d(0.0614866, 0.154851, -0.355955);
  options.solids.resize(1);
  options.solids[0].shape = {Sphere{Vec3d(0.0766234, 0.0703731, 0.139524), 0.025604}};
  options.liquid.resize(2);
  options.liquid[0].shape = {Sphere{Vec3d(0.0451589, 0.0194159, 0.0995111), 0.015543}};
  options.liquid[1].shape = {
      Cylinder{Vec3d(0.0228753, 0.0644619, 0.0370116), Vec3d(0.0134539, 0.0982148, 0.0297378), 0.0141548}};
  for (LiquidBody& body : options.liquid) body.velocity = Vec3d(0.0928071, -0.582038, -0.241598);
  Solver solver(options);
  double fastest = 0.0;
  for (int n = 0; n < 16; ++n) {
    solver.next();
    fastest = std::max(fastest, fastestOf(solver.state()));
  }
  CHECK(fastest < 6.0);
}
