#include "sim/markers/markers.h"
#include "sim/flows/move_surface.h"

#include "sim/step/solver.h"
#include "sim/surface/advect_phi.h"
#include "sim/surface/level_set.h"
#include "sim/surface/redistance.h"
#include "tests/sim/markers/unit_cube.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

using namespace fluidtex::sim;

namespace {

double ball(const Vec3d& x) {
  return (x - Vec3d(0.5, 0.5, 0.5)).length() - 0.25;
}

Velocity flow(const std::function<Vec3d(const Vec3d&)>& field) {
  FloatTree topology(0.0f);
  for (int i = -8; i < kCells + 8; i += 8)
    for (int j = -8; j < kCells + 8; j += 8)
      for (int k = -8; k < kCells + 8; k += 8) topology.touchLeaf(Coord(i, j, k))->setValuesOn();
  return velocityField(kVoxel, topology, field);
}

bool same(const Markers& a, const Markers& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (a[n].origin != b[n].origin || a[n].markers.size() != b[n].markers.size()) return false;
    if (std::memcmp(a[n].markers.data(), b[n].markers.data(), a[n].markers.size() * sizeof(Marker)) != 0)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("markers: each lies on its own side, within the band, in its block, and touches the surface") {
  const Markers markers = seedMarkers(*phiOf(ball), *noSolid(), 1);
  // The shell of 1.5 cells either side holds 16 a cell.
  const double shell =
      4.0 / 3.0 * std::numbers::pi * (std::pow(0.25 + 1.5 * kVoxel, 3) - std::pow(0.25 - 1.5 * kVoxel, 3));
  CHECK(double(countOf(markers)) == Approx(16.0 * shell / std::pow(kVoxel, 3)).epsilon(0.05));
  int wrong = 0;
  for (const MarkerBlock& block : markers) {
    for (const Marker& m : block.markers) {
      const double distance = ball(worldOf(block, m)) / kVoxel, radius = std::abs(m.radius);
      wrong += (m.radius < 0.0f) != (distance < 0.0) && std::abs(distance) > 0.05;
      wrong += std::abs(distance) > 3.1;
      wrong += std::abs(radius - std::clamp(std::abs(distance), 0.1, 0.5)) > 0.05;
      for (const float x : {m.x, m.y, m.z}) wrong += !(x >= 0.0f && x < 8.0f);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("markers: a right surface is not touched by them, a spoilt one is put right") {
  const auto phi = phiOf(ball);
  const Markers markers = seedMarkers(*phi, *noSolid(), 1);
  const auto right = phi->deepCopy();
  correctPhi(*phi, markers, *noSolid());
  int changed = 0;
  for (auto it = right->cbeginValueOn(); it; ++it) changed += phi->tree().getValue(it.getCoord()) != *it;
  CHECK(changed == 0);
  // The grid has lost half a cell of the ball all around.
  for (auto it = phi->beginValueOn(); it; ++it) it.setValue(*it + 0.5f * float(kVoxel));
  const auto error = [&] {
    double sum = 0.0, count = 0.0;
    for (auto it = right->cbeginValueOn(); it; ++it) {
      if (std::abs(*it) > 0.5 * kVoxel) continue;
      sum += std::abs(phi->tree().getValue(it.getCoord()) - *it) / kVoxel;
      count += 1.0;
    }
    return sum / count;
  };
  CHECK(error() == Approx(0.5).margin(1e-3));
  correctPhi(*phi, markers, *noSolid());
  CHECK(error() < 0.25);  // the more markers a cell has, the nearer
}

TEST_CASE("markers: those in a solid correct nothing, and cells deep in it keep what is extrapolated there") {
  // Liquid that has left the solid above half-way, of which some markers are still in it.
  const auto lying = phiOf([](const Vec3d& x) { return std::max(x[2] - 0.55, 0.3 - x[2]); });
  const auto left = phiOf([](const Vec3d& x) { return std::max(x[2] - 0.45, 0.3 - x[2]); });
  const double wall = 0.5 + 0.3 * kVoxel;
  const auto solid = phiOf([](const Vec3d& x) { return 0.5 + 0.3 * kVoxel - x[2]; });
  const auto changes = [&](const Markers& markers, double from) {
    const auto corrected = left->deepCopy();
    correctPhi(*corrected, markers, *solid);
    int count = 0;
    for (auto it = left->cbeginValueOn(); it; ++it)
      count +=
          left->indexToWorld(it.getCoord())[2] > from && corrected->tree().getValue(it.getCoord()) != *it;
    return count;
  };
  Markers markers = seedMarkers(*lying, *noSolid(), 1);
  CHECK(changes(markers, wall + 0.5 * kVoxel) == 0);
  CHECK(changes(markers, 0.0) > 100);
  std::size_t kept = 0;
  for (MarkerBlock& block : markers) {
    std::erase_if(block.markers, [&](const Marker& m) {
      // Beyond the box no solid is known.
      const Vec3d x = worldOf(block, m);
      return x[2] < wall || std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) > 0.4;
    });
    kept += block.markers.size();
  }
  CHECK(kept > 100);
  CHECK(changes(markers, 0.0) == 0);
}

TEST_CASE("markers: move with the flow, over the edges of blocks too") {
  const auto phi = phiOf(ball);
  const Markers before = seedMarkers(*phi, *noSolid(), 1);
  // A rigid turn by a tenth about the vertical through the middle, in steps of at most two cells.
  const auto turn = [](const Vec3d& x) { return Vec3d(-(x.y() - 0.5), x.x() - 0.5, 0.0); };
  const Velocity velocity = flow(turn);
  Markers after = before;
  for (int n = 0; n < 4; ++n) after = advectMarkers(after, velocity, 0.025);
  CHECK(countOf(after) == countOf(before));
  double sumBefore[3] = {}, sumAfter[3] = {}, worst = 0.0;
  for (const MarkerBlock& block : before) {
    for (const Marker& m : block.markers) {
      const Vec3d x = worldOf(block, m) - Vec3d(0.5);
      const double c = std::cos(0.1), s = std::sin(0.1);
      const Vec3d turned(c * x.x() - s * x.y(), s * x.x() + c * x.y(), x.z());
      for (int a = 0; a < 3; ++a) sumBefore[a] += turned[a] + turned[a] * turned[(a + 1) % 3];
    }
  }
  for (const MarkerBlock& block : after) {
    for (const Marker& m : block.markers) {
      const Vec3d x = worldOf(block, m) - Vec3d(0.5);
      worst = std::max(worst, std::abs(ball(x + Vec3d(0.5))) / kVoxel);
      for (int a = 0; a < 3; ++a) sumAfter[a] += x[a] + x[a] * x[(a + 1) % 3];
    }
  }
  for (int a = 0; a < 3; ++a) CHECK(std::abs(sumAfter[a] - sumBefore[a]) < 1e-5 * double(countOf(before)));
  CHECK(worst < 3.1);
}

TEST_CASE("markers: one that leaves its block by less than rounding stays where it is") {
  const Velocity slow = flow([](const Vec3d&) { return Vec3d(-1e-9, 0.0, 0.0); });
  Markers markers{{Coord(8, 8, 8), {Marker{0.0f, 4.3f, 0.5f, 0.5f}}}};
  const Vec3d before = worldOf(markers[0], markers[0].markers[0]);
  markers = advectMarkers(markers, slow, 1.0);
  REQUIRE(countOf(markers) == 1);
  CHECK((worldOf(markers[0], markers[0].markers[0]) - before).length() < 1e-6);
  CHECK(markers[0].markers[0].x < 8.0f);
}

TEST_CASE("markers: one that comes out on the other side of a thin wall is gone") {
  // A plate from 16 to 17.3 cells.
  Options options;
  options.resolution = kCells;
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.5, -1.0, -1.0), Vec3d(0.5 + 1.3 * kVoxel, 2.0, 2.0)}};
  const auto solid = Solids(options).at(0.0);
  REQUIRE(solid->visibility != nullptr);
  const Velocity through = flow([](const Vec3d&) { return Vec3d(0.9 * kVoxel, 0.0, 0.0); });
  // Of one of the liquid, so many cells from the first one's centre.
  const auto left = [&](float x, const Visibility* visibility) {
    const int first = static_cast<int>(x) & ~(kLeafDim - 1);
    const Marker marker{x - float(first), 2.0f, 2.0f, -0.3f};
    return countOf(advectMarkers({{Coord(first, 8, 8), {marker}}}, through, 1.0, visibility));
  };
  // In the plate; before it; behind it.
  CHECK(left(16.1f, nullptr) == 1);
  CHECK(left(16.1f, solid->visibility.get()) == 0);
  CHECK(left(15.1f, solid->visibility.get()) == 1);
  CHECK(left(17.1f, solid->visibility.get()) == 1);
}

TEST_CASE("markers: those of the air go where liquid meets liquid") {
  const auto phi = phiOf(ball);
  const Markers before = seedMarkers(*phi, *noSolid(), 1);
  const auto air = [](const Markers& markers) {
    std::size_t count = 0;
    for (const MarkerBlock& block : markers)
      for (const Marker& m : block.markers) count += m.radius > 0.0f;
    return count;
  };
  // A flow that closes at a rate of 20 a second; in 0.001 s by 0.02, in 0.01 s by 0.2 of a cell.
  const Velocity closing = flow([](const Vec3d& x) { return Vec3d(-20.0 * (x.x() - 0.5), 0.0, 0.0); });
  CHECK(air(advectMarkers(before, closing, 0.001)) == air(before));
  const Markers after = advectMarkers(before, closing, 0.01);
  CHECK(air(after) == 0);
  CHECK(countOf(after) == countOf(before) - air(before));
}

TEST_CASE("markers: keep a thin sheet through a vortex and back, where the grid alone loses it") {
  const double kPi = std::numbers::pi;
  const auto noWalls = noSolid();
  const auto loss = [&](bool withMarkers) {
    const auto phi = phiOf([](const Vec3d& x) { return (x - Vec3d(0.5, 0.75, 0.5)).length() - 0.15; });
    Markers markers = seedMarkers(*phi, *noWalls, 1);
    const auto volume = [&] {
      double sum = 0.0;
      for (auto it = phi->cbeginValueOn(); it; ++it) sum += std::clamp(0.5 - *it / kVoxel, 0.0, 1.0);
      for (auto it = phi->cbeginValueOff(); it; ++it)
        if (*it < 0.0f) sum += double(it.getVoxelCount());
      return sum;
    };
    const double start = volume();
    const double period = 2.0;
    constexpr int kSteps = 128;
    for (int n = 0; n < kSteps; ++n) {
      const double c = std::cos(kPi * (n + 0.5) / kSteps), dt = period / kSteps;
      const Velocity velocity = flow([&](const Vec3d& x) {
        const double sx = std::sin(kPi * x.x()), sy = std::sin(kPi * x.y());
        return c * Vec3d(-sx * sx * std::sin(2 * kPi * x.y()), sy * sy * std::sin(2 * kPi * x.x()), 0.0);
      });
      if (withMarkers) {
        SolidField solid;
        solid.phi = solid.phiMirrored = noWalls;
        moveSurface(*phi, markers, {velocity, solid, dt, std::uint64_t(n)});
        continue;
      }
      advectPhi(*phi, velocity, *noWalls, dt);
      redistance(*phi, *noWalls);
      trimBand(*phi, *noWalls);
    }
    return 1.0 - volume() / start;
  };
  const double with = loss(true), without = loss(false);
  INFO("lost " << with << " with markers, " << without << " without");
  CHECK(std::abs(with) < 0.15);  // a ball of ten cells across: 0.10, and 0.44 without
  CHECK(without > 3.0 * std::abs(with));
}

TEST_CASE("markers: the same seed gives the same, another one others") {
  const auto phi = phiOf(ball);
  CHECK(same(seedMarkers(*phi, *noSolid(), 5), seedMarkers(*phi, *noSolid(), 5)));
  CHECK_FALSE(same(seedMarkers(*phi, *noSolid(), 5), seedMarkers(*phi, *noSolid(), 6)));
}

TEST_CASE("markers: the scene's seed decides where they are, and no frame's are another seed's of the next") {
  const auto markersOf = [](std::uint64_t seed, int frames) {
    Options options;
    options.resolution = 12;
    options.seed = seed;
    options.liquid = {{{Box{Vec3d(0.0), Vec3d(0.5, 1.0, 0.5)}}}};
    Solver solver(options);
    for (int frame = 0; frame < frames; ++frame) solver.next();
    return solver.state().markers;
  };
  REQUIRE(countOf(markersOf(1, 1)) > 1000);
  CHECK(same(markersOf(1, 2), markersOf(1, 2)));
  for (const int frames : {1, 2}) CHECK_FALSE(same(markersOf(1, frames), markersOf(2, frames)));
  for (std::int64_t steps = 0; steps < 20; ++steps)
    for (std::int64_t later = 0; later < 20; ++later) CHECK(markerSeed(2, steps) != markerSeed(1, later));
}

TEST_CASE("markers: none deep in solids, thinned ones are filled up again") {
  const auto phi = phiOf(ball);
  const auto floor = makePhi(kVoxel, 3 * kVoxel);
  unite(
      *floor, [](const Vec3d& x) { return x.z() - 0.5; }, firstCells(Coord(kCells)));
  Markers markers = seedMarkers(*phi, *floor, 1);
  for (const MarkerBlock& block : markers)
    for (const Marker& m : block.markers) REQUIRE(worldOf(block, m).z() > 0.5 - kVoxel);
  const std::size_t full = countOf(markers);
  for (MarkerBlock& block : markers) block.markers.resize(block.markers.size() / 4 + 1);
  maintainMarkers(markers, *phi, *floor, 2);
  CHECK(double(countOf(markers)) == Approx(double(full)).epsilon(0.05));
}

TEST_CASE("markers: liquid that has run over a wall keeps none of the air between") {
  const auto floorAt = [](const Vec3d& x) { return x.z() - 0.5; };
  // The liquid lies nine tenths of a cell deep; the marker of the air is six tenths above the floor.
  const auto phi = makePhi(kVoxel, 6 * kVoxel);
  unite(
      *phi, [](const Vec3d& x) { return x.z() - 0.5 - 0.9 * kVoxel; }, grown(firstCells(Coord(kCells)), 8));
  const auto floor = makePhi(kVoxel, 3 * kVoxel);
  unite(*floor, floorAt, firstCells(Coord(kCells)));
  const auto airBelow = [&](const FloatGrid& solid) {
    // Positions are measured from the centre of the block's first cell, which is half a cell above the floor.
    Markers markers = {{Coord(8, 8, 16), {{3.3f, 4.2f, 0.1f, 0.1f}}}};
    maintainMarkers(markers, *phi, solid, 3);
    const MarkerBlock* block = findBlock(markers, Coord(8, 8, 16));
    REQUIRE(block != nullptr);
    return std::count_if(block->markers.begin(), block->markers.end(),
                         [](const Marker& m) { return m.x == 3.3f && m.y == 4.2f && m.radius > 0.0f; });
  };
  CHECK(airBelow(*noSolid()) == 1);
  CHECK(airBelow(*floor) == 0);
}
