#include "sim/surface/cell_volume.h"
#include "sim/surface/level_set.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace fluidtex::sim;

namespace {

// Liquid in a column of a tank of 16 cells with a plate across it, all in cells. phi: by height.
double cellsShown(double plateLow, double plateHigh, const std::function<double(double)>& phiAt) {
  constexpr double h = 1.0 / 16;
  Options options = tank(16, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(-1.0, -1.0, plateLow * h), Vec3d(2.0, 2.0, plateHigh * h)}};
  const auto solid = Solids(options).at(0.0);
  const FloatGrid::Ptr phi = makePhi(h, 4 * h);
  unite(
      *phi, [&](const Vec3d& x) { return h * phiAt(x[2] / h); }, firstCells(Coord(16)));
  return liquidVolume(*phi, *solid) / h;
}

}  // namespace

TEST_CASE("cell volume: a film that no cell centre is in is not counted, one with a centre is") {
  Options options = tank(8, {});
  const auto solid = Solids(options).at(0.0);
  const auto film = [&](double depth) {
    FloatGrid::Ptr phi = makePhi(0.125, 1.0);
    for (int n = 0; n < 512; ++n)
      phi->tree().setValue(Coord(n >> 6, n >> 3 & 7, n & 7), float(((n & 7) + 0.5) * 0.125 - depth));
    return liquidVolume(*phi, *solid);
  };
  CHECK(film(0.05) == 0.0);
  CHECK(film(0.1) == Catch::Detail::Approx(0.1).epsilon(1e-5));
  CHECK(film(0.3) == Catch::Detail::Approx(0.3).epsilon(1e-5));
}

TEST_CASE("cell volume: a cell that a thin wall parts is open on its roomier side only") {
  Options options = tank(8, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.52, -1.0, -1.0), Vec3d(0.60, 2.0, 2.0)}};  // around centre 4.5
  const auto solid = Solids(options).at(0.0);
  LeafShares open;
  openShares(*solid, Coord(0), open);
  for (int c = 0; c < 64; ++c) {
    const Coord cell(4, c >> 3, c & 7);
    CHECK(open[4 * 64 + c] == Catch::Detail::Approx(0.2).epsilon(1e-3));
    CHECK(open[3 * 64 + c] == 1.0f);
    CHECK(open[5 * 64 + c] == 1.0f);
    CHECK(solid->open[0].tree().getValue(cell) == 0.0f);
    CHECK(solid->open[0].tree().getValue(cell.offsetBy(1, 0, 0)) == 1.0f);
  }
}

TEST_CASE("cell volume: walls between one cell and two leave cells their open part") {
  // Of 0.97 m between walls of 1.5 cells.
  for (int n = 0; n < 10; ++n) {
    const double low = 0.3 + 0.01 * n, thick = 1.5 / 24.0;
    Options options = tank(24, {box(Vec3d(-1.0), Vec3d(2.0, 2.0, 0.5))});
    options.solids.resize(2);
    options.solids[0].shape = {Box{Vec3d(low - thick, -1.0, -1.0), Vec3d(low, 2.0, 2.0)}};
    options.solids[1].shape = {Box{Vec3d(low + 0.3, -1.0, -1.0), Vec3d(low + 0.3 + thick, 2.0, 2.0)}};
    Solver solver(options);
    CHECK(solver.next().stats.volume == Catch::Detail::Approx((1.0 - 2.0 * thick) * 0.5).epsilon(1e-4));
  }
}

TEST_CASE("cell volume: of a film between wall and air only what lies between counts") {
  // A floor in the middle of a layer of cells, and liquid 0.3 cells deep on it.
  CHECK(cellsShown(-16.0, 5.4, [](double z) { return z - 5.7; }) == Catch::Detail::Approx(0.3).epsilon(0.01));
}

TEST_CASE("cell volume: a film on a floor above a cell's centre counts up to its surface") {
  // The floor takes more than half of a layer of cells, and the film ends in the next layer, below its
  // centres.
  CHECK(cellsShown(-16.0, 5.6, [](double z) { return z - 6.2; }) == Catch::Detail::Approx(0.6).epsilon(1e-3));
}

TEST_CASE("cell volume: liquid below a thin plate does not count above it") {
  // A layer of cells has its centres in the plate, and its room below.
  const auto liquid = [](double z) { return z < 6.0 ? -2.0 : z - 6.3; };
  CHECK(cellsShown(5.25, 5.95, liquid) == Catch::Detail::Approx(5.25).epsilon(1e-3));
}

TEST_CASE("cell volume: what stands behind a thin wall changes nothing before it") {
  // A wall of a cell, from the centres of cells 4 to those of cells 5. Before it liquid ends at the centres.
  Options options = tank(8, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.5625, -1.0, -1.0), Vec3d(0.6875, 2.0, 2.0)}};
  const auto solid = Solids(options).at(0.0);
  for (const double behind : {-0.3, 0.125, 0.375}) {
    const FloatGrid::Ptr phi = makePhi(0.125, 0.5);
    unite(
        *phi, [&](const Vec3d& x) { return x[0] < 0.6 ? x[2] - 0.5625 : behind; }, firstCells(Coord(8)));
    LeafShares liquid;
    liquidShares(*phi, *solid, Coord(0), liquid);
    CAPTURE(behind);
    CHECK(liquid[4 * 64 + 4 * 8 + 4] == Catch::Detail::Approx(0.25));
  }
}

TEST_CASE("volume: a pool that just covers a block shows all of its liquid and stays at rest") {
  // The block's top takes more than half of a layer of cells, and the level is below the next layer's
  // centres.
  const double h = 1.0 / 16, level = 7.08 * h;
  Options options = tank(16, {box(Vec3d(0.0), Vec3d(1.0, 1.0, level))});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(-1.0), Vec3d(0.55, 2.0, 6.66 * h)}};
  Solver solver(options);
  for (int n = 0; n < 10; ++n) {
    const FrameStats stats = solver.next().stats;
    CHECK(std::abs(stats.deficit) < 1e-4 * stats.volume);
    CHECK(fastestOf(solver.state()) < 1e-2);
  }
}

TEST_CASE("volume: surface and deficit together stay where liquid separates from solids that cut cells") {
  Options options = tank(32, {});
  options.size = Vec3d(1.0, 0.51601, 0.9577);
  options.solids.resize(2);
  options.solids[0].shape = {Box{Vec3d(0.3982, -0.03, -0.03), Vec3d(0.4686, 0.55, 0.98)}};
  options.solids[1].shape = {
      Difference{{{Cylinder{Vec3d(0.4536, 0.3266, -0.03), Vec3d(0.4536, 0.3266, 0.89), 0.1316}},
                  {Cylinder{Vec3d(0.4536, 0.3266, 0.474), Vec3d(0.4536, 0.3266, 0.93), 0.0658}}}}};
  options.liquid.resize(1);
  options.liquid[0] = {Shape{Cylinder{Vec3d(0.3088, 0.297, 0.5627), Vec3d(0.3072, 0.0272, 0.4627), 0.1114}},
                       Vec3d(0.6, 1.56, 0.12)};
  Solver solver(options);
  FrameStats stats = solver.next().stats;
  const double poured = stats.volume + stats.deficit;
  for (int n = 0; n < 8; ++n) {
    stats = solver.next().stats;
    REQUIRE(stats.volume + stats.deficit == Catch::Detail::Approx(poured).epsilon(2e-5));
  }
}

TEST_CASE("volume: a solid that appears in liquid pushes it aside, and says so") {
  Options options = tank(24, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.4))});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.3, 0.3, -0.1), Vec3d(0.7, 0.7, 0.6)}};
  options.solids[0].from = 0.1;
  Solver solver(options);
  const double first = solver.next().stats.volume;
  for (int n = 0; n < 8; ++n) {
    const FrameStats stats = solver.next().stats;
    REQUIRE((stats.volume + stats.deficit) / first == Catch::Detail::Approx(1.0).epsilon(1e-4));
  }
  REQUIRE_FALSE(solver.warnings().empty());
  CHECK_THAT(solver.warnings()[0], Catch::Contains("a solid appears in 0.06"));
}

TEST_CASE("volume: a paddle that stirs a pool neither makes liquid nor loses any") {
  Options options = tank(24, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.25))});
  options.size = Vec3d(1.0, 1.0, 0.6);
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.15, 0.42, -0.1), Vec3d(0.85, 0.58, 0.4)}};
  options.solids[0].pivot = Vec3d(0.5, 0.5, 0.0);
  options.solids[0].keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.5, Vec3d(0.0), 360.0}};
  Solver solver(options);
  const double first = solver.next().stats.volume;
  for (int n = 0; n < 12; ++n) {
    const FrameStats stats = solver.next().stats;
    REQUIRE(std::abs((stats.volume + stats.deficit) / first - 1.0) < 0.01);
    REQUIRE(std::abs(stats.volume / first - 1.0) < 0.02);
  }
}

TEST_CASE("volume: a drop that is lost is volume deficit") {
  Options options = tank(16, {{Shape{Sphere{Vec3d(0.5, 0.5, 0.2), 0.06}}, Vec3d(0.0), 0.0}});
  Solver solver(options);
  FrameStats last = solver.next().stats;
  // A part of it is no surface to begin with.
  const double first = last.volume + last.deficit;
  CHECK(first == Catch::Detail::Approx(4.0 / 3.0 * std::numbers::pi * std::pow(0.06, 3)).epsilon(0.05));
  for (int n = 0; n < 12; ++n) last = solver.next().stats;
  CHECK((last.volume + last.deficit) / first == Catch::Detail::Approx(1.0).epsilon(1e-3));
  CHECK(last.deficit > 0.02 * first);
  CHECK(solver.warnings().empty());  // a few cells' worth
}

TEST_CASE(
    "volume: liquid that a piston presses on and that has no way out is volume deficit, and the run says so "
    "once") {
  Options options = tank(16, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.4))});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(-0.1, -0.1, 0.5), Vec3d(1.1, 1.1, 0.9)}};
  options.solids[0].keyframes = {{0.0, Vec3d(0.0), 0.0}, {0.5, Vec3d(0.0, 0.0, -0.25), 0.0}};
  Solver solver(options);
  const double first = solver.next().stats.volume;
  FrameStats last;
  for (int n = 0; n < 12; ++n) last = solver.next().stats;
  CHECK(std::abs((last.volume + last.deficit) / first - 1.0) < 0.01);
  CHECK(last.deficit > 0.2 * first);
  REQUIRE(solver.warnings().size() == 1);
  CHECK_THAT(solver.warnings()[0], Catch::Contains("m3 less than it should"));
}

TEST_CASE("volume: of a slab of two cells with edges volume and deficit are what it has") {
  // 7.3 x 7.6 x 2.2 cells.
  const Vec3d low(0.274, 0.078, 0.179), high(0.525, 0.339, 0.253);
  Solver solver(tank(29, {box(low, high)}));
  const FrameStats first = solver.next().stats;
  const Vec3d size = high - low;
  CHECK((first.volume + first.deficit) / (size[0] * size[1] * size[2]) ==
        Catch::Detail::Approx(1.0).epsilon(0.04));
}

TEST_CASE("volume: no deficit in what a wall leaves of a cell above the liquid") {
  // The liquid ends in the floor, half a cell below where the room above it begins.
  Options options = tank(20, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.2249))});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(-1.0, -1.0, -1.0), Vec3d(2.0, 0.7, 0.235)}};
  Solver solver(options);
  const FrameStats first = solver.next().stats;
  CHECK((first.volume + first.deficit) / (0.3 * 0.2249) == Catch::Detail::Approx(1.0).epsilon(0.01));
}

TEST_CASE("volume: a slab without a cell's centre is all deficit, poured at the start or later") {
  const Vec3d low(0.2, 0.2, 0.5050), high(0.8, 0.8, 0.5230);  // 0.36 cells thick, between two centres
  for (const double from : {0.0, 1.5 / 24.0}) {
    Options options = tank(20, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.1)), box(low, high)});
    options.liquid[1].from = from;
    Solver solver(options);
    FrameStats stats;
    for (int n = 0; n < 4; ++n) stats = solver.next().stats;
    const double expected = 0.1 + 0.6 * 0.6 * 0.018;
    // The slab's edges are those of cells.
    CHECK((stats.volume + stats.deficit) / expected == Catch::Detail::Approx(1.0).epsilon(0.02));
  }
}
