#include "sim/motion/known_flow.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kCells = 32;
constexpr double kVoxel = 1.0 / kCells;

// The largest sum of fluxes out of a cell of the unit cube, per cell width, m/s.
double largestDivergence(const Velocity& velocity) {
  double largest = 0.0;
  for (int n = 0; n < kCells * kCells * kCells; ++n) {
    const Coord c(n / (kCells * kCells), n / kCells % kCells, n % kCells);
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      Coord up = c;
      ++up[a];
      sum += velocity[a].tree().getValue(up) - velocity[a].tree().getValue(c);
    }
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

}  // namespace

TEST_CASE("known flow: what has a potential is free of divergence in every cell", "[sim]") {
  for (const KnownFlow& flow : {singleVortex(2.0), deformation2d(), deformation3d(), diagonal(), rotation(),
                                drawnOut(deformation3d(), Vec3d(1.0), 2.0)}) {
    const Velocity velocity = faceVelocity(flow, Coord(kCells), 2, kVoxel);
    CHECK(maxAbs(velocity) > 0.5);
    CHECK(largestDivergence(velocity) < 1e-5);
  }
}

TEST_CASE("known flow: no flow of the unit cube leaves it", "[sim]") {
  for (const KnownFlow& flow : {singleVortex(2.0), deformation3d()}) {
    const Velocity velocity = faceVelocity(flow, Coord(kCells), 2, kVoxel);
    for (int n = 0; n < kCells * kCells; ++n) {
      const int i = n / kCells, j = n % kCells;
      for (const int end : {0, kCells}) {
        REQUIRE(std::abs(velocity[0].tree().getValue(Coord(end, i, j))) < 1e-5f);
        REQUIRE(std::abs(velocity[1].tree().getValue(Coord(i, end, j))) < 1e-5f);
        REQUIRE(std::abs(velocity[2].tree().getValue(Coord(i, j, end))) < 1e-5f);
      }
    }
  }
}

TEST_CASE("known flow: velocities by their formulas", "[sim]") {
  // A turn about the middle, exact for a quadratic stream function.
  const Velocity turn = faceVelocity(rotation(Vec3d(0.5), 2.0), Coord(kCells), 0, kVoxel);
  CHECK_THAT(turn[0].tree().getValue(Coord(3, 20, 5)), WithinAbs(-2.0 * (20.5 * kVoxel - 0.5), 1e-5));
  CHECK_THAT(turn[1].tree().getValue(Coord(3, 20, 5)), WithinAbs(2.0 * (3.5 * kVoxel - 0.5), 1e-5));
  CHECK(turn[2].tree().getValue(Coord(3, 20, 5)) == 0.0f);
  // Vertical faces of the vortex: u = -sin^2(pi x) sin(2 pi y) in the middle of the upper half.
  const Velocity vortex = faceVelocity(singleVortex(2.0), Coord(kCells), 0, kVoxel);
  CHECK_THAT(vortex[0].tree().getValue(Coord(16, 24, 0)),
             WithinAbs(-std::sin(2.0 * std::numbers::pi * 24.5 * kVoxel), 0.01));
  const KnownFlow stretched = stretch(Vec3d(0.5), 3.0);
  CHECK(stretched.velocity(Vec3d(0.75, 0.1, 0.9)) == Vec3d(0.75, 0.0, 0.0));
  CHECK(still().velocity(Vec3d(0.3)) == Vec3d(0.0));
}

TEST_CASE("known flow: those that reverse have moved by nothing at their end", "[sim]") {
  for (const KnownFlow& flow : {singleVortex(3.0), deformation2d(), deformation3d(1.5)}) {
    double way = 0.0;
    constexpr int kSteps = 1000;
    for (int n = 0; n < kSteps; ++n) way += flow.strength(flow.duration * (n + 0.5) / kSteps);
    CHECK(std::abs(way) < 1e-9 * kSteps);
    CHECK(flow.strength(0.0) > 0.0);
  }
}

TEST_CASE("known flow: scaled by a factor, leaf by leaf", "[sim]") {
  const Velocity from = faceVelocity(rotation(), Coord(kCells), 0, kVoxel);
  Velocity to = copyOf(from);
  scale(from, -0.5, to);
  for (const Coord& c : {Coord(0), Coord(3, 20, 5), Coord(31, 31, 31)})
    for (int a = 0; a < 3; ++a) CHECK(to[a].tree().getValue(c) == -0.5f * from[a].tree().getValue(c));
}
