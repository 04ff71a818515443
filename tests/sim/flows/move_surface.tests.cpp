#include "sim/flows/move_surface.h"

#include "sim/surface/level_set.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

using namespace fluidtex::sim;

namespace {

constexpr int kCells = 32;
constexpr double kVoxel = 1.0 / kCells;

// A ball of liquid in a tank, with its markers.
struct Ball {
  SolidField solid;
  FloatGrid::Ptr phi = makePhi(kVoxel, 6 * kVoxel);
  Markers markers;

  Ball() {
    Options options;
    options.resolution = kCells;
    solid = *Solids(options).at(0.0);
    unite(
        *phi, [](const Vec3d& x) { return (x - Vec3d(0.4, 0.5, 0.5)).length() - 0.2; },
        firstCells(Coord(kCells)));
    trimBand(*phi, *solid.phi);
    markers = seedMarkers(*phi, *solid.phi, 0);
  }
};

Velocity uniform(const Vec3d& speed) {
  FloatTree topology(0.0f);
  for (int i = -8; i < kCells + 8; i += 8)
    for (int j = -8; j < kCells + 8; j += 8)
      for (int k = -8; k < kCells + 8; k += 8) topology.touchLeaf(Coord(i, j, k))->setValuesOn();
  return velocityField(kVoxel, topology, [&](const Vec3d&) { return speed; });
}

}  // namespace

TEST_CASE("move surface: a ball is carried by velocity times time, keeps its volume and its markers",
          "[sim]") {
  Ball ball;
  const Velocity velocity = uniform(Vec3d(1.0, 0.0, 0.0));
  const double before = liquidVolume(*ball.phi, ball.solid), dt = 1.6 * kVoxel;
  for (int n = 0; n < 4; ++n)
    moveSurface(*ball.phi, ball.markers, {velocity, ball.solid, dt, markerSeed(7, n)});
  CHECK(liquidVolume(*ball.phi, ball.solid) == Approx(before).epsilon(2e-3));
  double worst = 0.0;
  for (auto it = ball.phi->cbeginValueOn(); it; ++it) {
    const Vec3d x = ball.phi->indexToWorld(it.getCoord());
    if (std::abs(*it) < kVoxel)
      worst = std::max(worst, std::abs(*it - ((x - Vec3d(0.4 + 4 * dt, 0.5, 0.5)).length() - 0.2)));
  }
  CHECK(worst < 0.1 * kVoxel);
  CHECK_FALSE(ball.markers.empty());
}

TEST_CASE("move surface: five cells or more in a step are refused", "[sim]") {
  for (const double cells : {5.0, 40.0, -7.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    INFO(cells << " cells");
    Ball ball;
    CHECK_THROWS_AS(
        moveSurface(*ball.phi, ball.markers, {uniform(Vec3d(cells * kVoxel, 0.0, 0.0)), ball.solid, 1.0, 1}),
        std::invalid_argument);
  }
}

TEST_CASE("move surface: seeds differ from step to step and from scene to scene", "[sim]") {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t scene = 0; scene < 8; ++scene)
    for (std::int64_t step = 0; step < 64; ++step) seeds.insert(markerSeed(scene, step));
  CHECK(seeds.size() == 8 * 64);
  CHECK(markerSeed(3, 5) == markerSeed(3, 5));
}
