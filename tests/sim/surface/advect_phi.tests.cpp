#include "sim/surface/advect_phi.h"

#include "tests/sim/surface/surface_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;

namespace {

// Zalesak's disk as in the level-set papers: [0,100]^2, slot 5 wide, closed at y = 85; a cylinder along z
// here.
double zalesak(const Vec3d& x) {
  const double disk = std::hypot(x.x() - 50.0, x.y() - 75.0) - 15.0;
  const double slot = std::max(std::abs(x.x() - 50.0) - 2.5, x.y() - 85.0);
  return std::max(disk, -slot);
}

}  // namespace

TEST_CASE("advect phi: a translated ball keeps its volume and place") {
  Surface f(1.0 / 64, Coord(64), ball(Vec3d(0.35, 0.4, 0.45), 0.15));
  const Velocity velocity = f.velocity([](const Vec3d&) { return Vec3d(0.3, 0.2, 0.1); });
  const double before = f.volume();
  for (int n = 0; n < 20; ++n) f.advance(velocity, 0.05);
  INFO("volume " << f.volume() / before - 1.0);
  CHECK(std::abs(f.volume() / before - 1.0) < 2e-3);
  CHECK(f.distanceError(1.0, ball(Vec3d(0.65, 0.6, 0.55), 0.15)) < 0.1 * f.h);
}

TEST_CASE("advect phi: a long way at once is gone in steps that the trace can take") {
  Surface f(1.0 / 64, Coord(64), ball(Vec3d(0.3, 0.5, 0.5), 0.15));
  const Velocity velocity = f.velocity([](const Vec3d&) { return Vec3d(12.5 / 64, 0.0, 0.0); });
  const double before = f.volume();
  f.advance(velocity, 1.0);
  CHECK(std::abs(f.volume() / before - 1.0) < 1e-3);
  CHECK(f.distanceError(1.0, ball(Vec3d(0.3 + 12.5 / 64, 0.5, 0.5), 0.15)) < 0.03 * f.h);
}

TEST_CASE("advect phi: cells deep in a solid are left as they are") {
  Surface f(1.0 / 32, Coord(32), ball(Vec3d(0.5), 0.3));
  // Solid below z = 0.5.
  for (FloatLeaf* leaf : leavesOf(f.phi->tree())) {
    FloatLeaf* solid = f.noSolid->tree().touchLeaf(leaf->origin());
    for (int i = 0; i < kLeafSize; ++i) {
      const double z = f.phi->indexToWorld(solid->offsetToGlobalCoord(i)).z();
      solid->setValueOn(i, static_cast<float>(std::clamp(z - 0.5, -3.0 * f.h, 3.0 * f.h)));
    }
  }
  const FloatGrid::Ptr was = f.phi->deepCopy();
  advectPhi(*f.phi, f.velocity([](const Vec3d&) { return Vec3d(0.2, 0.0, 0.0); }), *f.noSolid, 0.3);
  int deepMoved = 0, moved = 0;
  for (auto it = was->cbeginValueOn(); it; ++it) {
    if (f.phi->tree().getValue(it.getCoord()) == *it) continue;
    const bool deep = f.phi->indexToWorld(it.getCoord()).z() < 0.5 - 3.0 * f.h;
    ++(deep ? deepMoved : moved);
  }
  CHECK(deepMoved == 0);
  CHECK(moved > 1000);
}

TEST_CASE("advect phi: Zalesak's disk after one turn") {
  // One revolution is 628; without reinitialisation fifth-order WENO is known to lose 1.04 % at 100 cells,
  // with an interface error (symmetric difference over perimeter) of 0.131.
  Surface f(1.0, Coord(100, 100, 8), zalesak);
  const double perimeter = 143.805, depth = 7.0;
  const Velocity velocity = f.velocity(
      [](const Vec3d& x) { return Vec3d(50.0 - x.y(), x.x() - 50.0, 0.0) * (std::numbers::pi / 314.0); });
  const double before = f.volume();
  // Steps of up to two cells, as the solver's own: what interpolation smears grows with their number.
  for (int n = 0; n < 157; ++n) f.advance(velocity, 4.0);
  const double change = f.volume() / before - 1.0, error = f.difference(zalesak) / depth / perimeter;
  INFO("volume " << change << ", interface error " << error);
  CHECK(std::abs(change) < 0.015);
  CHECK(error < 0.16);
}

TEST_CASE("advect phi: no liquid is read through a plate that a step is longer than") {
  // Water on a plate of 1.7 cells, air below it, which moves down by 2.5 cells in a step.
  const double h = 1.0 / 32, top = 0.5 + 1.7 * h;
  Surface f(h, Coord(32), [&](const Vec3d& x) { return top - x.z(); });
  FloatGrid::Ptr plate = makePhi(h, 3 * h);
  unite(
      *plate, [&](const Vec3d& x) { return std::max(0.5 - x.z(), x.z() - top); },
      grown(firstCells(Coord(32)), 8));
  advectPhi(*f.phi, f.velocity([](const Vec3d&) { return Vec3d(0.0, 0.0, -1.0); }), *plate, 2.5 * h);
  for (int k = 10; k < 16; ++k) CHECK(f.phi->tree().getValue(Coord(16, 16, k)) > 0.0f);  // the plate is at 16
  CHECK(f.phi->tree().getValue(Coord(16, 16, 20)) < 0.0f);
}
