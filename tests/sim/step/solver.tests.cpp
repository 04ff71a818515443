#include "sim/step/solver.h"
#include "tests/sim/step/solver_scenes.h"

#include "sim/grid/mac_grid.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace fluidtex::sim;

namespace {

Velocity velocityOf(const State& state) {
  return state.velocity;
}

// Mean of the third component over active faces where phi is inside.
double meanFall(const State& state) {
  double sum = 0.0, count = 0.0;
  for (auto it = state.velocity.component[2]->cbeginValueOn(); it; ++it) {
    if (state.phi->tree().getValue(it.getCoord()) >= 0.0f) continue;
    sum += *it;
    count += 1.0;
  }
  return sum / count;
}

Frame frameAfter(const Options& options, int frames) {
  Solver solver(options);
  Frame frame = solver.next();
  REQUIRE(frame.stats.volume + frame.stats.deficit > 0.0);
  while (frame.index < frames) frame = solver.next();
  return frame;
}

// Cells inside the visible surface above a height.
int cellsAbove(const Frame& frame, double height) {
  int count = 0;
  for (auto it = frame.surfacePhi->cbeginValueOn(); it; ++it)
    if (*it < 0.0f && frame.surfacePhi->indexToWorld(it.getCoord()).z() > height) ++count;
  return count;
}

double centreHeight(const Frame& frame) {
  double sum = 0.0, count = 0.0;
  const double h = frame.surfacePhi->voxelSize()[0];
  for (auto it = frame.surfacePhi->cbeginValueAll(); it; ++it) {
    if (!it.isVoxelValue() && *it > 0.0f) continue;
    const double share = std::clamp(0.5 - *it / h, 0.0, 1.0);
    openvdb::CoordBBox where;
    it.getBoundingBox(where);
    const Vec3d middle = (where.min().asVec3d() + where.max().asVec3d()) * 0.5;
    sum += share * static_cast<double>(where.volume()) * frame.surfacePhi->indexToWorld(middle).z();
    count += share * static_cast<double>(where.volume());
  }
  return sum / count;
}

}  // namespace

TEST_CASE("solver: a tank of water stays at rest") {
  Solver solver(tank(24, {box(Vec3d(-1.0), Vec3d(2.0, 2.0, 0.513))}));
  const double first = solver.next().stats.volume;
  CHECK(std::abs(first - 0.513) < 1e-3);
  for (int n = 2; n <= 20; ++n) {
    const Frame frame = solver.next();
    CHECK(maxAbs(velocityOf(solver.state())) < 1e-3 * std::sqrt(9.81));
    CHECK(std::abs(frame.stats.volume / first - 1.0) < 1e-4);
    CHECK(frame.substeps.size() >= 1);
  }
}

TEST_CASE("solver: a falling drop is accelerated by gravity and keeps its volume") {
  Solver solver(tank(48, {{Shape{Sphere{Vec3d(0.5, 0.5, 0.7), 0.15}}, Vec3d(0.3, 0.0, 0.0), 0.0}}));
  Frame frame = solver.next();
  const double volume = frame.stats.volume, height = centreHeight(frame);
  for (int n = 2; n <= 6; ++n) frame = solver.next();
  // The velocity is that of the middle of the next substep.
  const double t = frame.time, then = t + solver.state().leapfrogOffset;
  CHECK(std::abs(meanFall(solver.state()) / (-9.81 * then) - 1.0) < 1e-4);
  CHECK(std::abs(frame.stats.volume / volume - 1.0) < 0.01);
  CHECK(std::abs(centreHeight(frame) - (height - 0.5 * 9.81 * t * t)) < 0.1 / 48);
}

TEST_CASE("solver: a column that collapses keeps its volume") {
  // The surface alone loses 5% of it by then.
  Solver solver(tank(24, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5))}));
  const FrameStats start = solver.next().stats;
  const double first = start.volume + start.deficit;
  double late = 0.0;
  for (int n = 2; n <= 40; ++n) {
    const FrameStats stats = solver.next().stats;
    const double change = stats.volume / first - 1.0;
    CHECK(std::abs(change) < 0.03);  // with the films that no cell's centre is in
    CHECK((stats.volume + stats.deficit) / first == Catch::Detail::Approx(1.0).epsilon(1e-4));
    if (n > 30) late += 0.1 * change;
  }
  // What is missing in one frame is on its way, and there in another.
  CHECK(std::abs(late) < 0.01);
}

TEST_CASE("solver: what a splash loses when a solid goes is volume deficit") {
  Options options =
      tank(32, {box(Vec3d(0.0), Vec3d(0.45, 1.0, 0.25)), box(Vec3d(0.1, 0.2, 0.5), Vec3d(0.4, 0.8, 0.9))});
  Solid gate;
  gate.shape.kind = Box{Vec3d(0.5, -1.0, -1.0), Vec3d(0.6, 2.0, 2.0)};
  gate.until = 12.0 / 24.0;
  options.solids = {gate};
  Solver solver(options);
  // Where the surface is, and what is on its way.
  const auto water = [&] {
    const Frame frame = solver.next();
    double deficit = 0.0;
    if (solver.state().deficit) {
      for (auto it = solver.state().deficit->cbeginValueOn(); it; ++it) deficit += *it;
    }
    return frame.stats.volume + deficit / (32.0 * 32.0 * 32.0);
  };
  double before = 0.0;
  for (int n = 1; n <= 12; ++n) before = water();
  CHECK(std::abs(water() / before - 1.0) < 0.005);
}

TEST_CASE(
    "solver: however large the deficit, the surface moves by half a cell a step at most to give it back") {
  Options options = tank(32, {{Shape{Sphere{Vec3d(0.5), 0.28}}, Vec3d(0.0), 0.0}});
  options.gravity = Vec3d(0.0);
  Solver made(options);
  made.next();
  State state = made.state();
  state.deficit = FloatGrid::create(0.0f);
  for (auto it = state.phi->cbeginValueOn(); it; ++it) {
    if (*it < 0.0f) state.deficit->tree().setValueOn(it.getCoord(), 5.0f);
  }
  Solver solver(options, state);
  const double dt = solver.next().substeps.back().dt;
  const State& now = solver.state();
  REQUIRE(now.expansion.component[0] != nullptr);
  CHECK_THAT(maxAbs(now.expansion) * dt * 32.0, Catch::Matchers::WithinRel(0.5, 1e-5));
}

TEST_CASE("solver: a gap below water closes") {
  for (const double gap : {0.1, 0.3, 0.45, 0.6, 1.2}) {
    Options options = tank(16, {box(Vec3d(0.0, 0.0, gap / 16.0), Vec3d(1.0, 1.0, 0.3))});
    Solver solver(options);
    const FrameStats first = solver.next().stats;
    for (int n = 0; n < 16; ++n) solver.next();
    const State& state = solver.state();
    CAPTURE(gap);
    CHECK(state.phi->tree().getValue(Coord(8, 8, -1)) < 0.0f);
    const double level = 4.5 - 16.0 * state.phi->tree().getValue(Coord(8, 8, 4));
    CHECK(level == Catch::Detail::Approx(16.0 * (first.volume + first.deficit)).margin(0.05));
    CHECK(fastestOf(state) < 0.1);
  }
}

TEST_CASE("solver: a gap between a pool and what is above it stays") {
  for (const double gap : {0.15, 0.3, 0.45, 0.6, 1.2}) {
    Options options = tank(16, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.5 - gap / 16.0))});
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(0.25, 0.25, 0.5), Vec3d(0.75, 0.75, 0.8)}};
    Solver solver(options);
    for (int n = 0; n < 10; ++n) solver.next();
    const State& state = solver.state();
    CAPTURE(gap);
    CHECK(fastestOf(state) < 1e-3);
    for (const int i : {2, 8}) {  // beside the box and below it
      const double level = 7.5 - 16.0 * state.phi->tree().getValue(Coord(i, 8, 7));
      CHECK(level == Catch::Detail::Approx(8.0 - gap).margin(0.02));
    }
  }
}

TEST_CASE("solver: a pool stays at rest in a slot of a third of a cell between two blocks") {
  Options options = tank(30, {box(Vec3d(0.0), Vec3d(1.0, 0.663813852, 0.201867024))});
  options.size = Vec3d(1.0, 0.663813852, 0.488517605);
  options.solids.resize(2);
  options.solids[0].shape = {
      Box{Vec3d(0.240451705, 0.510497605, 0.183958659), Vec3d(0.509887119, 0.656416878, 0.374585215)}};
  options.solids[1].shape = {
      Box{Vec3d(0.21890862, 0.460383943, 0.0670086093), Vec3d(0.370253971, 0.547800651, 0.242229909)}};
  Solver solver(options);
  for (int n = 0; n < 20; ++n) {
    solver.next();
    CHECK(std::abs(solver.state().velocity.component[2]->tree().getValue(Coord(11, 15, 6))) < 0.03f);
  }
}

TEST_CASE("solver: water leaves a ceiling") {
  Solver solver(tank(24, {box(Vec3d(0.25, 0.25, 0.8), Vec3d(0.75, 0.75, 1.0))}));
  const double start = centreHeight(solver.next());
  Frame frame;
  for (int n = 2; n <= 7; ++n) frame = solver.next();
  const double fallen = start - centreHeight(frame), free = 0.5 * 9.81 * frame.time * frame.time;
  INFO("fallen " << fallen << " of " << free);
  CHECK(fallen > 0.7 * free);
  // Nothing hangs on: no liquid within two cells of the ceiling.
  const double h = 1.0 / 24;
  CHECK(cellsAbove(frame, 1.0 - 2.0 * h) == 0);
}

TEST_CASE("solver: a velocity of no use ends with a sentence, not with endless substeps") {
  Solver solver(tank(16, {{Shape{Sphere{Vec3d(0.5), 0.2}}, Vec3d(0.0, 0.0, 1e9), 0.0}}));
  solver.next();
  CHECK_THROWS_WITH(solver.next(), Catch::Contains("m/s") && Catch::Contains("cannot go on"));
}

TEST_CASE(
    "solver: a viscosity of no use ends with a sentence that tells how far the solve came, already in the "
    "first "
    "frame") {
  Options options = tank(16, {{Shape{Sphere{Vec3d(0.5), 0.2}}, Vec3d(1.0, 0.0, 0.0), 0.0}});
  options.viscosity = 1e308;
  options.density = 1e10;
  Solver solver(options);
  CHECK_THROWS_WITH(solver.next(), Catch::Contains("viscosity solve did not converge") &&
                                       Catch::Contains("nan") && Catch::Contains("cannot go on at time 0 s"));
}

TEST_CASE("solver: nothing hangs at a ceiling, however little it is") {
  const double h = 1.0 / 24;
  Options options;
  SECTION("a drop of one cell") {
    options = tank(24, {{Shape{Sphere{Vec3d(0.48, 0.48, 1.0 - 0.4 * h), 0.6 * h}}, Vec3d(0.0), 0.0}});
  }
  SECTION("a drop between cells") {
    options = tank(24, {{Shape{Sphere{Vec3d(0.5, 0.5, 1.0 - 0.5 * h), 0.9 * h}}, Vec3d(0.0), 0.0}});
  }
  SECTION("a film of a third of a cell") {
    options = tank(24, {box(Vec3d(0.3, 0.3, 1.0 - 0.3 * h), Vec3d(0.7, 0.7, 1.0))});
  }
  SECTION("a film of one cell and a third") {
    options = tank(24, {box(Vec3d(0.3, 0.3, 1.0 - 1.3 * h), Vec3d(0.7, 0.7, 1.0))});
  }
  Solver solver(options);
  const FrameStats first = solver.next().stats;
  REQUIRE(first.volume + first.deficit > 0.0);
  Frame frame;
  for (int n = 2; n <= 12; ++n) frame = solver.next();
  CHECK(cellsAbove(frame, 1.0 - 2.0 * h) == 0);
  CHECK(frame.stats.volume + frame.stats.deficit ==
        Catch::Detail::Approx(first.volume + first.deficit).epsilon(1e-4));
}

TEST_CASE("solver: a film that is poured on a wall and flies off it is all there") {
  // The only cell's centre that it reaches lies just in the wall.
  const double h = 1.0 / 16.0, wall = 8.51 * h, surface = 9.35 * h;
  Options options = tank(16, {box(Vec3d(0.0), Vec3d(surface, 1.0, 1.0))});
  options.liquid[0].velocity = Vec3d(2.0, 0.0, 0.0);
  Solid solid;
  solid.shape = {Box{Vec3d(-1.0), Vec3d(wall, 2.0, 2.0)}};
  options.solids.push_back(solid);
  const FrameStats start = frameAfter(options, 1).stats;
  CHECK(start.volume + start.deficit == Approx(surface - wall).epsilon(0.01));
}

TEST_CASE("solver: a film on a wall falls when no liquid feeds it, on the floor it stays") {
  const double h = 1.0 / 24;
  const Frame onWall = frameAfter(tank(24, {box(Vec3d(0.0, 0.3, 0.5), Vec3d(0.3 * h, 0.7, 0.9))}), 4);
  const Frame onFloor = frameAfter(tank(24, {box(Vec3d(0.3, 0.3, 0.0), Vec3d(0.7, 0.7, 0.3 * h))}), 4);
  // Freely, for three frames.
  CHECK(cellsAbove(onWall, 0.9 - 0.5 * 9.81 / 64.0 + 1.5 * h) == 0);
  CHECK(onWall.stats.volume + onWall.stats.deficit == Catch::Detail::Approx(0.16 * 0.3 * h).epsilon(0.05));
  CHECK(onFloor.stats.volume + onFloor.stats.deficit == Catch::Detail::Approx(0.16 * 0.3 * h).epsilon(0.2));
  // A column in a corner falls; no thread of it stays behind.
  const Frame inCorner = frameAfter(tank(24, {box(Vec3d(0.0, 0.0, 0.5), Vec3d(0.6 * h, 0.6 * h, 1.0))}), 12);
  CHECK(cellsAbove(inCorner, 0.3) == 0);
}

TEST_CASE("solver: substeps are the motion of phi, and fill the frame") {
  Solver solver(tank(24, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5))}));
  const Frame first = solver.next();
  CHECK(first.index == 1);
  CHECK(first.time == 0.0);
  CHECK(first.substeps.empty());
  double last = 0.0;
  for (int n = 2; n <= 8; ++n) {
    const FloatGrid::ConstPtr before = solver.state().velocity.component[0],
                              expansion = solver.state().expansion.component[0];
    const Frame frame = solver.next([&](double share) {
      CHECK(share >= 0.0);
      CHECK(share <= 1.0);
      last = share;
    });
    CHECK(last == 1.0);
    CHECK(frame.index == n);
    CHECK(std::abs(frame.time - (n - 1) / 24.0) < 1e-12);
    // The velocity and what makes the liquid grow, together.
    bool sums = true;
    const FloatTree& moved = frame.substeps.front().u->tree();
    for (auto it = moved.cbeginValueOn(); it; ++it) {
      const float more = expansion == nullptr ? 0.0f : expansion->tree().getValue(it.getCoord());
      sums = sums && *it == before->tree().getValue(it.getCoord()) + more;
    }
    CHECK(sums);
    double sum = 0.0;
    for (const Substep& substep : frame.substeps) {
      sum += substep.dt;
      CHECK(substep.u->tree().hasSameTopology(substep.v->tree()));
      CHECK(substep.u->tree().hasSameTopology(substep.w->tree()));
      CHECK(substep.dt * maxAbs({{substep.u->deepCopy(), substep.v->deepCopy(), substep.w->deepCopy()}}) *
                24 <
            3.01);
    }
    CHECK(std::abs(sum - 1.0 / 24.0) < 1e-9);
    CHECK(frame.stats.dtMin > 0.0);
    CHECK(frame.stats.pressureResidual < 1e-5);
    CHECK(frame.stats.cells > 2000);
  }
}

TEST_CASE("solver: the surface is closed at walls and a distance around itself") {
  Solver solver(tank(24, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.5))}));
  const Frame frame = solver.next();
  const openvdb::FloatGrid& phi = *frame.surfacePhi;
  const double h = phi.voxelSize()[0];
  CHECK(phi.background() >= 4.0 * h);
  int wrong = 0, flat = 0;
  for (auto it = phi.cbeginValueOn(); it; ++it) {
    const Vec3d x = phi.indexToWorld(it.getCoord());
    const Vec3d low = -x, high = x - Vec3d(0.4, 1.0, 0.5);
    std::array<double, 6> sides{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
    std::sort(sides.begin(), sides.end());
    const double inside = sides[5];  // the distance, where negative
    if (inside > 0.0 && *it < 0.0f) ++wrong;
    if (inside > 0.0 || inside < -3.0 * h) continue;
    // Upwind distances are too short near ridges, where two sides are as near.
    const bool ridge = sides[4] > inside - 3.0 * h;
    if (std::abs(*it - inside) > (ridge ? 0.4 : 0.02) * h) ++wrong;
    flat += ridge ? 0 : 1;
  }
  CHECK(wrong == 0);
  CHECK(flat > 500);
  CHECK(std::abs(frame.stats.volume - 0.2) < 0.003);
}

TEST_CASE("solver: nothing to simulate is a valid scene") {
  Solver solver(tank(16, {}));
  for (int n = 1; n <= 3; ++n) {
    const Frame frame = solver.next();
    CHECK(frame.index == n);
    CHECK(frame.surfacePhi->activeVoxelCount() == 0);
    CHECK(frame.stats.volume == 0.0);
  }
}

TEST_CASE("solver: bodies are poured in at their time, once") {
  LiquidBody late = {Shape{Sphere{Vec3d(0.5, 0.5, 0.7), 0.15}}, Vec3d(0.0, 0.0, -1.0), 2.5 / 24.0};
  Solver solver(tank(24, {box(Vec3d(-1.0), Vec3d(2.0, 2.0, 0.2)), late}));
  double volume[6];
  for (int n = 1; n <= 5; ++n) volume[n] = solver.next().stats.volume;
  const double ball = 4.0 / 3.0 * 3.14159265 * std::pow(0.15, 3);
  CHECK(std::abs(volume[3] - 0.2) < 2e-3);
  CHECK(std::abs(volume[4] - 0.2 - ball) < 2e-3);
  CHECK(std::abs(volume[5] - volume[4]) < 1e-3);
  CHECK(solver.state().poured == std::vector<bool>{true, true});
}

TEST_CASE("solver: liquid inside a solid is cut out, and a wall that vanishes sets the water free") {
  Options options = tank(24, {box(Vec3d(0.0), Vec3d(0.5, 1.0, 0.5))});
  Solid wall;
  wall.shape = Shape{Box{Vec3d(0.375, -1.0, -1.0), Vec3d(0.5, 2.0, 2.0)}};
  wall.until = 3.0 / 24.0;
  options.solids.push_back(wall);
  Solver solver(options);
  const double first = solver.next().stats.volume;
  CHECK(std::abs(first - 0.375 * 0.5) < 2e-3);
  for (int n = 2; n <= 3; ++n) {
    solver.next();
    CHECK(fastestOf(solver.state()) < 1e-5);
  }
  CHECK(std::abs(solver.next().stats.volume / first - 1.0) < 0.025);  // the wall has just gone
  for (int n = 5; n <= 8; ++n) solver.next();
  CHECK(maxAbs(velocityOf(solver.state())) > 0.8);
}

TEST_CASE("solver: the same bytes on one thread and on two") {
  const auto run = [](int threads) {
    return onThreads(threads, [&] {
      Solver solver(tank(24, {box(Vec3d(0.0), Vec3d(0.4, 1.0, 0.6))}));
      Frame frame;
      for (int n = 1; n <= 7; ++n) frame = solver.next();
      return std::pair(solver.state(), frame);
    });
  };
  const auto [one, frameOne] = run(1);
  const auto [two, frameTwo] = run(2);
  CHECK(same(*one.phi, *two.phi));
  CHECK(same(*one.velocity.component[0], *two.velocity.component[0]));
  CHECK(same(*one.velocity.component[1], *two.velocity.component[1]));
  CHECK(same(*one.velocity.component[2], *two.velocity.component[2]));
  CHECK(same(*frameOne.surfacePhi, *frameTwo.surfacePhi));
  CHECK(frameOne.stats.volume == frameTwo.stats.volume);
}
