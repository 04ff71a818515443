#include "sim/scalars/carried_scalar.h"

#include "sim/step/solver.h"
#include "sim/step/state_io.h"
#include "tests/scratch.h"
#include "tests/sim/heat/pool.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

// Two columns of liquid, of mixtures 0 and 1, that fall against each other.
Options twoColumns(int resolution) {
  Options options;
  options.resolution = resolution;
  options.liquid.push_back({.shape = {Box{{0.0, 0.0, 0.0}, {0.3, 1.0, 0.5}}}});
  options.liquid.push_back({.shape = {Box{{0.7, 0.0, 0.0}, {1.0, 1.0, 0.5}}}, .mixture = 1.0});
  return options;
}

struct Mixed {
  double mean = 0.0, low = 1.0, high = 0.0, left = 0.0, right = 0.0;
};

// Over the liquid's cells; left and right: of the two halves.
Mixed mixedIn(const Frame& frame) {
  const FloatGrid& mixture = *frame.fields.at("mixture");
  Mixed result;
  double count = 0.0, side[2] = {0.0, 0.0};
  for (auto it = mixture.cbeginValueOn(); it; ++it) {
    if (frame.surfacePhi->tree().getValue(it.getCoord()) >= 0.0f) continue;
    const double value = *it;
    result.mean += value;
    count += 1.0;
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
    const bool onRight = mixture.indexToWorld(it.getCoord())[0] > 0.5;
    (onRight ? result.right : result.left) += value;
    side[onRight ? 1 : 0] += 1.0;
  }
  result.mean /= count;
  result.left /= side[0];
  result.right /= side[1];
  return result;
}

}  // namespace

TEST_CASE("carried scalar: a body's cells get its value, new leaves the background", "[sim]") {
  const Pool pool(16, 0.5, [](const Vec3d&) { return 300.0; });
  const FloatGrid::Ptr scalar = makeScalar(*makeScalar(pool.h, 0.25), pool.phi->tree());
  setInBody(
      *scalar, [](const Vec3d& x) { return (x - Vec3d(0.5)).length() - 0.25; }, 0.75);
  CHECK(scalar->tree().getValue(Coord(8, 8, 8)) == 0.75f);
  CHECK(scalar->tree().getValue(Coord(1, 1, 1)) == 0.25f);
  CHECK(makeScalar(*scalar, pool.phi->tree())->tree().getValue(Coord(8, 8, 8)) == 0.75f);
}

TEST_CASE("carried scalar: goes on constant into the air, as far as it is asked to", "[sim]") {
  const Pool pool(16, 0.5, [](const Vec3d&) { return 300.0; });
  const FloatGrid::Ptr scalar = makeScalar(*makeScalar(pool.h, 0.0), pool.phi->tree());
  setInBody(
      *scalar, [](const Vec3d& x) { return x[2] - 0.5; }, 1.0);
  for (auto it = scalar->beginValueOn(); it; ++it)
    if (it.getCoord()[2] >= 8) it.setValue(0.0f);
  extendScalar(*scalar, *pool.phi, *pool.solid.phi, 3);
  CHECK(scalar->tree().getValue(Coord(8, 8, 10)) == 1.0f);
  CHECK(scalar->tree().getValue(Coord(8, 8, 11)) == 0.0f);
}

TEST_CASE("solver: two liquids keep their mixtures where they do not meet, and mix where they do", "[sim]") {
  Solver solver(twoColumns(24));
  Mixed first = mixedIn(solver.next());
  CHECK(first.mean == Approx(0.5).margin(0.01));
  Mixed last;
  for (int frame = 0; frame < 12; ++frame) {
    last = mixedIn(solver.next());
    REQUIRE(last.low >= 0.0);
    REQUIRE(last.high <= 1.0);
  }
  // Equal parts stay equal parts; each has gone over to the other's side.
  CHECK(last.mean == Approx(0.5).margin(0.02));
  CHECK(last.left > 0.02);
  CHECK(last.right < 0.98);
}

TEST_CASE("solver: a mixture comes back from a file bit by bit, and a scene without one has none", "[sim]") {
  const Options options = twoColumns(16);
  Solver solver(options);
  solver.next();
  solver.next();
  const Scratch folder;
  writeState(solver.state(), folder.path / "state.vdb");
  Solver again(options, readState(folder.path / "state.vdb"));
  const Frame frame = solver.next(), other = again.next();
  const FloatGrid &a = *frame.fields.at("mixture"), &b = *other.fields.at("mixture");
  REQUIRE(a.activeVoxelCount() == b.activeVoxelCount());
  for (auto it = a.cbeginValueOn(); it; ++it) REQUIRE(*it == b.tree().getValue(it.getCoord()));

  Options plain = options;
  plain.liquid[1].mixture = 0.0;
  Solver without(plain);
  CHECK(without.next().fields.count("mixture") == 0);
  CHECK_THROWS_AS(Solver(options, without.state()), SolverError);
}

TEST_CASE("solver: what a source gives has the source's mixture", "[sim]") {
  Options options;
  options.resolution = 24;
  options.liquid.push_back({.shape = {Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.2}}}});
  Source source{.shape = {Sphere{{0.5, 0.5, 0.7}, 0.1}}, .velocity = {0.0, 0.0, -1.0}};
  source.mixture = 1.0;
  options.sources.push_back(source);
  Solver solver(options);
  solver.next();
  const double before = mixedIn(solver.next()).mean;
  Mixed after;
  for (int n = 0; n < 10; ++n) after = mixedIn(solver.next());
  CHECK(after.mean > before + 0.01);
  CHECK(after.high == Approx(1.0).margin(1e-6));
}
