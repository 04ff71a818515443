#include "sim/surface/redistance.h"

#include "tests/sim/surface/surface_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;

TEST_CASE("redistance: leaves the surface and makes a distance") {
  // A ball whose phi has the right zero set and slopes from 0.4 to 2.5.
  const Vec3d center(0.5, 0.47, 0.52);
  const Distance exact = ball(center, 0.3);
  Surface f(1.0 / 48, Coord(48), exact);
  for (auto it = f.phi->beginValueOn(); it; ++it) {
    const Vec3d x = f.phi->indexToWorld(it.getCoord());
    it.setValue(static_cast<float>(exact(x) * std::exp(0.9 * std::sin(9.0 * x.x()) * std::cos(7.0 * x.y()))));
  }
  const double before = f.volume();
  for (int n = 0; n < 5; ++n) redistance(*f.phi, *f.noSolid);
  CHECK(std::abs(f.volume() / before - 1.0) < 2e-3);
  CHECK(f.distanceError(1.0, exact) < 0.05 * f.h);
  CHECK(f.distanceError(4.0, exact) < 0.15 * f.h);
  // A hundred further calls move it, on average, by a fiftieth of a cell at most.
  const double settled = f.volume(), area = 4.0 * std::numbers::pi * 0.09;
  for (int n = 0; n < 100; ++n) redistance(*f.phi, *f.noSolid);
  CHECK(std::abs(f.volume() - settled) / area < 0.02 * f.h);
  CHECK(f.distanceError(1.0, exact) < 0.05 * f.h);
}

TEST_CASE("redistance: slopes of two become slopes of one, and then nothing moves any more") {
  Surface f(1.0 / 32, Coord(32), ball(Vec3d(0.5), 0.3));
  for (auto it = f.phi->beginValueOn(); it; ++it) it.setValue(*it * 2.0f);
  redistance(*f.phi, *f.noSolid);
  CHECK(f.distanceError(1.0, ball(Vec3d(0.5), 0.3)) < 0.003 * f.h);
  const FloatGrid::Ptr right = f.phi->deepCopy();
  for (int n = 0; n < 10; ++n) redistance(*f.phi, *f.noSolid);
  int kept = 0;
  for (auto it = f.phi->cbeginValueOn(); it; ++it) {
    if (std::abs(*it) > 0.5f * f.h) continue;
    CHECK(*it == right->tree().getValue(it.getCoord()));
    ++kept;
  }
  CHECK(kept > 100);
}

TEST_CASE("redistance: corners do not wear away") {
  // A box of three and a half cells, nowhere aligned with the grid.
  const Vec3d low(0.3, 0.31, 0.33), high = low + Vec3d(3.5 / 24);
  Surface f(1.0 / 24, Coord(24), [&](const Vec3d& x) {
    double inside = -1.0, outside = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double beyond = std::max(low[a] - x[a], x[a] - high[a]);
      inside = std::max(inside, beyond);
      outside += std::pow(std::max(0.0, beyond), 2);
    }
    return inside < 0.0 ? inside : std::sqrt(outside);
  });
  const double start = f.volume();
  for (int n = 0; n < 50; ++n) redistance(*f.phi, *f.noSolid);
  CHECK(f.volume() / start > 0.88);
}
