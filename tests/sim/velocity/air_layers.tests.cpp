#include "sim/velocity/air_layers.h"

#include "sim/velocity/extrapolate.h"
#include "tests/sim/velocity/liquid_faces.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("air layers: beyond a spreading ball the velocity is free of divergence") {
  // A sink inside would be right for u = x / |x|^3; what is given beyond is constant along the radius.
  LiquidFaces f(0.05, 24, [](const Vec3d& x) { return x.length() - 0.6; });
  const auto source = [](const Vec3d& x, int a) { return 0.36 * x[a] / std::pow(x.length(), 3); };
  f.setValid(source);
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  const auto divergence = [&](const Coord& c) {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      Coord up = c;
      up[a] += 1;
      sum += f.velocity.component[a]->tree().getValue(up) - f.velocity.component[a]->tree().getValue(c);
    }
    return sum / f.h;
  };
  const auto meanAt = [&](double from, double to) {
    double sum = 0.0;
    int count = 0;
    for (auto it = f.phi->cbeginValueOn(); it; ++it) {
      if (*it < from * f.h || *it >= to * f.h) continue;
      sum += divergence(it.getCoord());
      ++count;
    }
    return sum / count;
  };
  const Velocity before = copyOf(f.velocity);
  const double near = meanAt(0.0, 1.0), second = meanAt(1.0, 1.6);
  CHECK(near > 2.0);
  CHECK(second > 2.0);
  balanceAirLayers(f.velocity, f.valid, *f.phi, *f.solidPhi);
  CHECK(std::abs(meanAt(0.0, 1.0)) < 0.1 * near);
  // Some of these lie three cells from the liquid.
  CHECK(std::abs(meanAt(1.0, 1.6)) < 0.7 * second);
  const auto& masks = f.valid.component;
  bool same = true;
  for (int a = 0; a < 3; ++a) {
    for (auto it = masks[a]->cbeginValueOn(); it; ++it)
      same = same && f.velocity.component[a]->tree().getValue(it.getCoord()) ==
                         before.component[a]->tree().getValue(it.getCoord());
  }
  CHECK(same);
}

TEST_CASE("air layers: nothing gets faster than half as fast again, and solids keep their faces") {
  // Two bodies of liquid that meet: all air between them has to leave sideways.
  LiquidFaces f(0.1, 16, [](const Vec3d& x) { return 0.25 - std::abs(x[0]); });
  f.setValid([](const Vec3d& x, int a) { return a == 0 ? (x[0] > 0.0 ? -1.0 : 1.0) : 0.0; });
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  balanceAirLayers(f.velocity, f.valid, *f.phi, *f.solidPhi);
  CHECK(maxAbs(f.velocity) <= 1.5f);

  LiquidFaces wall(0.1, 16, [](const Vec3d& x) { return x[2] + 0.05; });
  for (auto it = wall.phi->cbeginValueOn(); it; ++it)
    wall.solidPhi->tree().setValue(it.getCoord(),
                                   static_cast<float>(0.2 - wall.phi->indexToWorld(it.getCoord())[2]));
  wall.setValid([](const Vec3d& x, int a) { return a == 0 ? x[0] : 0.0; });
  extrapolate(wall.velocity, wall.valid, *wall.phi, *wall.solidPhi);
  const Velocity before = copyOf(wall.velocity);
  balanceAirLayers(wall.velocity, wall.valid, *wall.phi, *wall.solidPhi);
  // The face between the last open cell and the wall, at z = 0.2, and one in the open.
  CHECK(wall.velocity.component[2]->tree().getValue(Coord(0, 0, 2)) ==
        before.component[2]->tree().getValue(Coord(0, 0, 2)));
  CHECK(wall.velocity.component[2]->tree().getValue(Coord(0, 0, 1)) < -0.05f);
}

TEST_CASE("air layers: what is linear in the liquid goes on linearly in the first layer") {
  LiquidFaces f(0.1, 16, [](const Vec3d& x) { return 0.6 * x[0] + 0.8 * x[2]; });
  const auto linear = [](const Vec3d& x, int a) { return 30.0 + a + x[0] - 2.0 * x[1] + 3.0 * x[2]; };
  f.setValid(linear);
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  extendLinearly(f.velocity, *f.phi);
  const auto& masks = f.valid.component;
  double worst = 0.0;
  int checked = 0;
  for (int a = 0; a < 3; ++a) {
    const FloatGrid& grid = *f.velocity.component[a];
    for (auto it = grid.cbeginValueOn(); it; ++it) {
      const Coord c = it.getCoord();
      // Away from the box' ends, above a face of the liquid.
      if (std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) > 12) continue;
      if (masks[a]->tree().isValueOn(c) || !masks[a]->tree().isValueOn(c.offsetBy(0, 0, -1))) continue;
      worst = std::max(worst, std::abs(*it - linear(grid.indexToWorld(c), a)));
      ++checked;
    }
  }
  CHECK(checked > 100);
  CHECK(worst < 1e-4);
}

TEST_CASE(
    "air layers: where no two faces of liquid lie in line what is carried is the liquid's, not the air's") {
  LiquidFaces f(0.1, 16, [](const Vec3d& x) { return x.length() - 0.11; });  // of a cell or two
  f.setValid([](const Vec3d&, int a) { return a == 2 ? -1.0 : 0.0; });
  // As fast as air that is squeezed out.
  for (int a = 0; a < 3; ++a) {
    const auto& masks = f.valid.component;
    for (auto it = f.velocity.component[a]->beginValueOn(); it; ++it)
      if (!masks[a]->tree().isValueOn(it.getCoord())) it.setValue(-2.25f);
  }
  extendLinearly(f.velocity, *f.phi);
  for (const auto& phi = f.phi->tree(); const FloatGrid::Ptr& grid : f.velocity.component) {
    for (auto it = grid->cbeginValueOn(); it; ++it) {
      bool near = false;
      for (int n = 0; n < 6; ++n) {
        Coord beside = it.getCoord();
        beside[n / 2] += n % 2 == 0 ? -1 : 1;
        near = near || phi.getValue(beside) < 0.0f;
      }
      if (near) REQUIRE(std::abs(*it) <= 1.2f);
    }
  }
}
