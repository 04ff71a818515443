#include "tools/stress_scenes/measures.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using sim::Vec3d;

TEST_CASE("stress: a front with surface tension gains no energy on a floor", "[stress]") {
  sim::Options options;
  options.resolution = 24;
  options.size = Vec3d(1.0, 0.25, 0.5);
  options.surfaceTension = 50.0;
  options.liquid.push_back({{sim::Box{Vec3d(0.0), Vec3d(0.33, 0.25, 0.25)}}});
  sim::Solver solver(options);
  sim::Solids solids(options);
  double start = 0.0;
  for (int n = 0; n < 8; ++n) {
    const sim::Frame frame = solver.next();
    const auto field = solids.around({solver.state().phi.get()}, frame.time, solids.active(frame.time));
    const stress::Measures now = stress::measure(solver.state(), *field, options);
    const double sum =
        now.kinetic + now.potential + now.surface - now.falling * solver.state().leapfrogOffset;
    if (n == 0) start = sum;
    CHECK(sum < 1.03 * start);
  }
}

TEST_CASE("stress: the mass that is measured is that of the volume, of thin sheets and cut cells too",
          "[stress]") {
  sim::Options options;
  options.resolution = 20;
  options.size = Vec3d(1.0, 0.93, 1.0);
  options.density = 800.0;
  options.liquid.push_back({{sim::Sphere{Vec3d(0.5, 0.4, 0.5), 0.2}}});
  options.liquid.push_back({{sim::Box{Vec3d(0.1, 0.1, 0.82), Vec3d(0.9, 0.8, 0.85)}}});
  sim::Solid solid;
  solid.shape = {sim::Sphere{Vec3d(0.6, 0.5, 0.4), 0.15}};
  options.solids.push_back(solid);
  sim::Solver solver(options);
  sim::Solids solids(options);
  for (int n = 0; n < 4; ++n) {
    const sim::Frame frame = solver.next();
    const auto field = solids.around({solver.state().phi.get()}, frame.time, solids.active(frame.time));
    const stress::Measures measures = stress::measure(solver.state(), *field, options);
    CHECK(measures.mass == Approx(800.0 * frame.stats.volume).epsilon(1e-4));
    CHECK(measures.thin > 0.0);
    CHECK(measures.thin < 0.9 * frame.stats.volume);
  }
}

TEST_CASE("stress: a film on a wall is thin as the sheet is of which it is half, a pool is not", "[stress]") {
  const double h = 1.0 / 16;
  const auto thin = [&](double low, double high) {
    sim::Options options;
    options.resolution = 16;
    options.gravity = Vec3d(0.0);
    options.liquid.push_back({{sim::Box{Vec3d(0.0, 0.0, low * h), Vec3d(1.0, 1.0, high * h)}}});
    sim::Solver solver(options);
    const sim::Frame frame = solver.next();
    sim::Solids solids(options);
    const auto field = solids.around({solver.state().phi.get()}, frame.time, solids.active(frame.time));
    return stress::measure(solver.state(), *field, options).thin;
  };
  CHECK(thin(0.0, 1.2) == Approx(1.2 * h).epsilon(1e-3));
  CHECK(thin(6.8, 9.2) == Approx(2.4 * h).epsilon(1e-3));
  CHECK(thin(0.0, 2.7) == 0.0);
  CHECK(thin(5.3, 10.7) == 0.0);
}

TEST_CASE("stress: what a sheet loses and regains as it flies has its motion, liquid at rest has none",
          "[stress]") {
  sim::Options options;
  options.resolution = 24;
  options.gravity = Vec3d(0.0);
  // Of 1.2 cells, and aslant.
  const sim::Cylinder sheet{Vec3d(0.3, 0.3, 0.3), Vec3d(0.32, 0.345, 0.31), 0.2};
  options.liquid.push_back({{sheet}, Vec3d(0.5, 1.0, 0.3)});
  options.liquid.push_back({{sim::Box{Vec3d(0.6, 0.0, 0.6), Vec3d(1.0, 0.4, 1.0)}}});
  sim::Solver solver(options);
  sim::Solids solids(options);
  double whole = 0.0, least = INFINITY, most = 0.0;
  for (int n = 0; n < 7; ++n) {
    const sim::Frame frame = solver.next();
    const auto field = solids.around({solver.state().phi.get()}, frame.time, solids.active(frame.time));
    const stress::Measures now = stress::measure(solver.state(), *field, options);
    if (n == 0) whole = now.kinetic + now.deficitMotion;
    CHECK(now.kinetic + now.deficitMotion == Approx(whole).epsilon(1e-5));
    least = std::min(least, now.kinetic);
    most = std::max(most, now.kinetic);
  }
  CHECK(most > 1.03 * least);  // else nothing was lost
}

TEST_CASE("stress: deficit in the air has its motion, beyond the narrow band that of all on the whole",
          "[stress]") {
  sim::Options options;
  options.resolution = 40;
  options.gravity = Vec3d(0.0);
  options.liquid.push_back({{sim::Sphere{Vec3d(0.3, 0.5, 0.5), 0.1}}, Vec3d(0.0, 3.0, 0.0)});
  options.liquid.push_back({{sim::Box{Vec3d(0.8, 0.0, 0.0), Vec3d(1.0)}}});
  sim::Solver solver(options);
  sim::Solids solids(options);
  const sim::Frame frame = solver.next();
  sim::State state = solver.state();
  const auto field = solids.around({state.phi.get()}, frame.time, solids.active(frame.time));
  const double cell = options.density * std::pow(options.voxelSize(), 3);
  const auto motionOf = [&](const sim::Coord& place, float amount) {
    state.deficit = sim::FloatGrid::create(0.0f);
    state.deficit->tree().setValueOn(place, amount);
    return stress::measure(state, *field, options).deficitMotion;
  };
  const sim::Coord besideSphere(12, 20, 26), besideBox(30, 20, 20), nowhere(20, 2, 38);
  for (const float amount : {0.5f, -0.5f}) {
    const double mass = amount * cell;
    CHECK(motionOf(besideSphere, amount) == Approx(0.5 * mass * 9.0).epsilon(1e-3));
    CHECK(motionOf(besideBox, amount) == Approx(0.0).margin(1e-6));
    const stress::Measures seen = stress::measure(state, *field, options);
    CHECK(motionOf(nowhere, amount) == Approx(mass * seen.kinetic / seen.mass).epsilon(1e-6));
  }
}

TEST_CASE("stress: motion of the surface's cells is what they would have if they were full", "[stress]") {
  sim::Options options;
  options.resolution = 20;
  const double h = options.voxelSize();
  // It covers the centres of the layer of cells that it ends in.
  options.liquid.push_back({{sim::Box{Vec3d(0.0), Vec3d(1.0, 1.0, 4.75 * h)}}});
  sim::Solver solver(options);
  const sim::Frame frame = solver.next();
  sim::State state = solver.state();
  state.velocity.component[0] = sim::FloatGrid::create(2.0f);
  sim::Solids solids(options);
  const auto field = solids.around({state.phi.get()}, frame.time, solids.active(frame.time));
  const stress::Measures now = stress::measure(state, *field, options);
  CHECK(now.surfaceMotion == Approx(0.5 * options.density * h * 4.0).epsilon(1e-5));
  CHECK(now.kinetic == Approx(4.75 * now.surfaceMotion).epsilon(1e-3));
}

TEST_CASE("stress: a state that was written and read again is the same, of liquid that is gone too",
          "[stress]") {
  sim::Options options;
  options.resolution = 16;
  sim::Solver solver(options);
  solver.next();
  sim::State one = solver.state(), other = one;
  one.deficit = sim::FloatGrid::create(0.0f);
  one.deficit->tree().setValueOn(sim::Coord(3), 0.5f);
  other.deficit = one.deficit->deepCopy();
  // A leaf that is gone leaves its inner node.
  one.deficit->tree().touchLeaf(sim::Coord(-300, 0, 0));
  delete one.deficit->tree().stealNode<sim::FloatLeaf>(sim::Coord(-300, 0, 0), 0.0f, false);
  CHECK(stress::difference(one, other).empty());
  other.deficit->tree().setValueOn(sim::Coord(4), 0.0f);
  CHECK(stress::difference(one, other) == "deficit, its cells");
  other.deficit->tree().setValueOff(sim::Coord(4), 0.0f);
  other.deficit->tree().addTile(1, sim::Coord(64), 0.25f, true);
  CHECK(stress::difference(one, other) == "deficit, a tile");
}
