#include "sim/surface_pressure.h"

#include "sim/level_set.h"
#include "sim/solids.h"
#include "tests/sim/solver_scenes.h"

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

Sides sidesOf(int cells, const FloatGrid& phi) {
  const auto solid = Solids(tank(cells, {})).at(0.0);
  const Velocity velocity = makeVelocity(1.0 / cells, phi.constTree());
  const auto& [u, v, w] = velocity.component;
  Sides sides{gatherLiquid(phi, *solid, {&u->constTree(), &v->constTree(), &w->constTree()}), {}};
  sides.pressure = SurfacePressure(sides.liquid, phi, *solid, 1.0);
  return sides;
}

}  // namespace

TEST_CASE("surface pressure: a film's middle yields to its outside") {
  // 1.2 cells thick: its inside has no smooth distance.
  const double h = 1.0 / 32;
  const auto film = makePhi(h, 4 * h);
  unite(
      *film, [&](const Vec3d& x) { return std::abs(x[2] - 0.5 - 0.5 * h) - 0.6 * h; }, firstCells(Coord(32)));
  const Sides sides = sidesOf(32, *film);
  for (const int side : {4, 5}) CHECK(std::abs(sides.at(Coord(16, 16, 16), side)) < 1e-3);
}

TEST_CASE("surface pressure: where the surface touches a cell's centre it is one for all sides") {
  // Any difference would act over next to no way, and throw the liquid out.
  constexpr int kCells = 16;
  const double h = 1.0 / kCells;
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
    const Sides sides = sidesOf(kCells, *phi);
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
