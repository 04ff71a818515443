#include "tools/stress_scenes/surroundings.h"

#include "tests/stress/tank.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using sim::Coord;
using sim::Vec3d;
using stress::addSolid;
using stress::boxShape;
using stress::Surroundings;
using stress::tank;

namespace {

sim::Shape without(sim::Shape whole, sim::Shape part) {
  return {sim::Difference{{std::move(whole), std::move(part)}}};
}

// Walls of half a cell around a room of ten cells a side.
sim::Options shutBox() {
  sim::Options options = tank(boxShape(Vec3d(0.25), Vec3d(0.75, 0.75, 0.45)));
  addSolid(options, without(boxShape(Vec3d(0.225), Vec3d(0.775)), boxShape(Vec3d(0.25), Vec3d(0.75))));
  return options;
}

}  // namespace

TEST_CASE("surroundings: a pool is at rest, a column, a drop and a pool that moves are not", "[stress]") {
  CHECK(Surroundings(tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.43))), {}).atRest());
  CHECK_FALSE(Surroundings(tank(boxShape(Vec3d(0.0), Vec3d(0.5, 1.0, 0.43))), {}).atRest());
  CHECK_FALSE(Surroundings(tank({sim::Sphere{Vec3d(0.5), 0.2}}), {}).atRest());
  sim::Options moves = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.43)));
  moves.liquid[0].velocity = Vec3d(0.1, 0.0, 0.0);
  CHECK_FALSE(Surroundings(moves, {}).atRest());
  sim::Options open = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.43)));
  open.sides[1] = sim::Side::open;
  CHECK_FALSE(Surroundings(open, {}).atRest());
}

TEST_CASE("surroundings: a pool with a gap at a wall is not at rest, however narrow the gap is", "[stress]") {
  const double cell = 0.05;
  for (const double gap : {0.03, 0.1, 0.25, 0.4}) {
    INFO("gap of " << gap << " cells");
    const double end = 1.0 - gap * cell;
    CHECK_FALSE(Surroundings(tank(boxShape(Vec3d(0.0), Vec3d(end, 1.0, 0.43))), {}).atRest());
    sim::Options cut = tank(boxShape(Vec3d(0.0), Vec3d(end, 1.0, 0.43)));
    addSolid(cut, boxShape(Vec3d(end, -cell, -cell), Vec3d(1.0 + cell)));
    CHECK(Surroundings(cut, {}).atRest());
    sim::Options above = tank(boxShape(Vec3d(0.0, 0.0, gap * cell), Vec3d(1.0, 1.0, 0.43)));
    CHECK_FALSE(Surroundings(above, {}).atRest());
  }
  sim::Options two = tank(boxShape(Vec3d(0.0), Vec3d(0.61, 1.0, 0.43)));
  two.liquid.push_back({boxShape(Vec3d(0.61, 0.0, 0.0), Vec3d(1.0, 1.0, 0.43))});
  CHECK(Surroundings(two, {}).atRest());
}

TEST_CASE("surroundings: a column beside an unbounded side may splash to any height", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(0.0), Vec3d(0.5, 1.0, 0.43)));
  options.sides[0] = sim::Side::unbounded;
  const Surroundings falls(options, {});
  CHECK_FALSE(falls.atRest());
  CHECK(falls.reached(Coord(19, 10, 15)));
}

TEST_CASE("surroundings: no way leads through a wall of half a cell, unless it is known to leak",
          "[stress]") {
  const sim::Options options = shutBox();
  const Surroundings held(options, {});
  CHECK(held.atRest());
  CHECK(held.reached(Coord(10, 10, 6)));
  CHECK_FALSE(held.reached(Coord(10, 10, 12)));  // there is a way, but nothing lifts liquid at rest
  CHECK_FALSE(held.reached(Coord(2, 10, 6)));
  const Surroundings leaks(options, {0});
  CHECK_FALSE(leaks.atRest());
  CHECK(leaks.reached(Coord(2, 10, 6)));
  // In free fall everything inside can be reached, and nothing outside.
  sim::Options falls = shutBox();
  falls.liquid[0].velocity = Vec3d(0.0, 0.0, 1.0);
  const Surroundings inside(falls, {});
  CHECK(inside.reached(Coord(10, 10, 12)));
  CHECK_FALSE(inside.reached(Coord(2, 10, 6)));
}

TEST_CASE("surroundings: liquid that reaches out of a wall by a tenth of a cell gets to that side too",
          "[stress]") {
  for (const double begin : {0.394, 0.41}) {
    sim::Options options = tank(boxShape(Vec3d(0.1, begin, 0.3), Vec3d(0.4, 0.8, 0.6)));
    addSolid(options, boxShape(Vec3d(-1.0, 0.4, -1.0), Vec3d(2.0, 0.5, 2.0)));
    CAPTURE(begin);
    CHECK(Surroundings(options, {}).reached(Coord(4, 7, 8)) == (begin < 0.4));
  }
}

TEST_CASE("surroundings: what leaves through one unbounded side may come back through another", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(0.1), Vec3d(0.3, 0.9, 0.5)));
  addSolid(options, boxShape(Vec3d(0.45, -1.0, -1.0), Vec3d(0.55, 2.0, 2.0)));
  CHECK_FALSE(Surroundings(options, {}).reached(Coord(15, 10, 10)));
  options.sides[0] = options.sides[1] = sim::Side::unbounded;
  const Surroundings around(options, {});
  CHECK(around.reached(Coord(15, 10, 10)));
  CHECK(around.reached(Coord(-40, 0, 0)));
  // It flows out, and may splash.
  CHECK_FALSE(around.atRest());
  CHECK(around.reached(Coord(4, 10, 18)));
}

TEST_CASE("surroundings: volumes are those of the shapes outside of solids", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(-1.0), Vec3d(0.513, 2.0, 0.377)));
  options.size = Vec3d(1.0, 0.729, 1.0);
  addSolid(options, {sim::Sphere{Vec3d(0.25, 0.4, 0.2), 0.15}});
  const double expected = 0.513 * 0.729 * 0.377 - 4.0 / 3.0 * M_PI * 0.15 * 0.15 * 0.15;
  CHECK(Surroundings(options, {}).pouredVolume() == Approx(expected).epsilon(0.003));
}

TEST_CASE("surroundings: a front gives its area times its speed, wherever it lies among the samples",
          "[stress]") {
  const double cell = 0.05, side = 3.5 * cell;
  sim::Options options = tank({sim::Sphere{Vec3d(0.5), 0.2}});
  const Surroundings surroundings(options, {});
  for (const double at : {0.0, 0.1, 0.25, 0.4, 0.6, 0.75}) {
    INFO("at " << at << " of a cell");
    const Vec3d low = Vec3d(0.3) + Vec3d(at * cell);
    const double rate = surroundings.frontRate(boxShape(low, low + Vec3d(side)), Vec3d(0.0, 0.0, -2.0), 0.0);
    CHECK(rate == Approx(2.0 * side * side).epsilon(0.02));
  }
}

TEST_CASE("surroundings: a shape's surface is what of it lies in the open", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.5)));
  const sim::Shape drain = boxShape(Vec3d(0.21, 0.32, 0.13), Vec3d(0.74, 0.85, 0.49));
  const double sides = 4.0 * 0.53 * 0.36, ends = 2.0 * 0.53 * 0.53;
  CHECK(Surroundings(options, {}).surfaceOf(drain, 0.0) == Approx(sides + ends).epsilon(0.03));
  addSolid(options, boxShape(Vec3d(-1.0), Vec3d(0.475, 2.0, 2.0)));
  CHECK(Surroundings(options, {}).surfaceOf(drain, 0.0) == Approx(0.5 * (sides + ends)).epsilon(0.15));
}

TEST_CASE("surroundings: beyond an unbounded side there is liquid, too", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(-0.3, 0.2, 0.1), Vec3d(0.4, 0.7, 0.6)));
  CHECK(Surroundings(options, {}).pouredVolume() == Approx(0.4 * 0.5 * 0.5).epsilon(0.01));
  options.sides[0] = sim::Side::unbounded;
  CHECK(Surroundings(options, {}).pouredVolume() == Approx(0.7 * 0.5 * 0.5).epsilon(0.01));
}

TEST_CASE("surroundings: what is poured into a narrow gap or beside a thin wall is told apart", "[stress]") {
  sim::Options gap = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.3)));
  CHECK(Surroundings(gap, {}).inNarrowGaps() == 0.0);
  CHECK(Surroundings(gap, {}).besideThinWalls() == 0.0);
  addSolid(gap, boxShape(Vec3d(0.2, 0.2, 0.03), Vec3d(0.8, 0.8, 0.5)));  // 0.6 cells above the floor
  CHECK(Surroundings(gap, {}).inNarrowGaps() == Catch::Detail::Approx(0.6 * 0.6 * 0.03).epsilon(0.2));
  // A box of half-cell walls, wet inside on four sides of 10 by 4 cells and a floor of 10 by 10.
  const double thin = Surroundings(shutBox(), {}).besideThinWalls() / std::pow(0.05, 3);
  CHECK(thin > 0.4 * (4 * 40 + 100));
  CHECK(thin < 0.7 * (4 * 40 + 100));
}

TEST_CASE("surroundings: gaps are found as well where samples begin below 0", "[stress]") {
  sim::Options gap = tank(boxShape(Vec3d(-0.3, 0.0, 0.0), Vec3d(1.0, 1.0, 0.3)));
  gap.sides[0] = sim::Side::unbounded;
  addSolid(gap, boxShape(Vec3d(0.2, 0.2, 0.03), Vec3d(0.8, 0.8, 0.5)));
  CHECK(Surroundings(gap, {}).inNarrowGaps() == Approx(0.6 * 0.6 * 0.03).epsilon(0.2));
}
