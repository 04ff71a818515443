#include "sim/grid/leaf_table.h"
#include "sim/solids/domain.h"
#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace fluidtex::sim;

namespace {

constexpr double kVoxel = 1.0 / 16.0;

// A ball of water without weight in [0, 1]^3, or in space without an end.
Options ballAt(const Vec3d& center, const Vec3d& velocity, Side side) {
  Options options;
  options.resolution = 16;
  options.sides.fill(side);
  options.gravity = Vec3d(0.0);
  options.liquid = {{Shape{Sphere{center, 0.25}}, velocity, 0.0}};
  return options;
}

// Of what lies above z = 0: behind a floor phi goes on.
Vec3d middleOf(const FloatGrid& phi) {
  Vec3d sum(0.0);
  double cells = 0.0;
  for (const Coord& origin : wetLeaves(phi, CoordBBox::inf())) {
    for (int c = 0; c < kLeafSize; ++c) {
      const Coord at = origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7);
      if (at.z() < 0) continue;
      const double share = std::clamp(0.5 - phi.tree().getValue(at) / kVoxel, 0.0, 1.0);
      sum += share * phi.indexToWorld(at);
      cells += share;
    }
  }
  return sum / cells;
}

// Whether b holds all that a does.
bool holdsAll(const FloatGrid& a, const FloatGrid& b) {
  const auto leaves = leavesOf(a.constTree());
  return !leaves.empty() && std::all_of(leaves.begin(), leaves.end(), [&](const FloatLeaf* leaf) {
    const FloatLeaf* other = b.constTree().probeConstLeaf(leaf->origin());
    return other != nullptr && *leaf == *other;
  });
}

}  // namespace

TEST_CASE("unbounded: liquid that keeps away from all sides cannot tell whether there are any", "[sim]") {
  Options inside = ballAt(Vec3d(0.48, 0.5, 0.5), Vec3d(0.3, 0.0, -0.1), Side::wall);
  inside.resolution = 48;  // so that there is room for the surface's band as well
  Options endless = inside;
  endless.sides.fill(Side::unbounded);
  Solver walls(inside), none(endless);
  for (int n = 0; n < 4; ++n) {
    walls.next();
    none.next();
  }
  CHECK(holdsAll(*none.state().phi, *walls.state().phi));
  CHECK(holdsAll(*none.state().velocity.component[0], *walls.state().velocity.component[0]));
}

TEST_CASE("unbounded: a ball flies out of [0, size], also to below 0, and keeps its volume", "[sim]") {
  const Vec3d center(0.5, 0.5, 0.5), velocity(-24.0, -12.0, 6.0);
  Solver solver(ballAt(center, velocity, Side::unbounded));
  const double volume = solver.next().stats.volume;
  Frame last;
  for (int n = 0; n < 8; ++n) last = solver.next();
  const Vec3d way = middleOf(*solver.state().phi) - center;
  CHECK((way - velocity * (8.0 / 24.0)).length() < 0.01 * way.length());
  CHECK(way.x() < -100.0 * kVoxel);
  CHECK(std::abs(last.stats.volume / volume - 1.0) < 0.01);
  CHECK(last.stats.cells > 200);
}

TEST_CASE("unbounded: a wall goes on beside a side without an end", "[sim]") {
  // Thrown onto the floor: in a hall of 8 x 6 m, and 8 m from there, out of a box of 1 m.
  Options hall = ballAt(Vec3d(6.5, 1.5, 0.35), Vec3d(-18.0, 12.0, -2.0), Side::wall);
  hall.size = Vec3d(8.0, 6.0, 1.0);
  hall.resolution = 128;
  Options none = ballAt(Vec3d(-1.5, 1.5, 0.35), Vec3d(-18.0, 12.0, -2.0), Side::unbounded);
  none.sides[4] = Side::wall;
  hall.gravity = none.gravity = Vec3d(0.0, 0.0, -9.81);
  Solver inHall(hall), outside(none);
  Frame a, b;
  for (int n = 0; n < 6; ++n) {
    a = inHall.next();
    b = outside.next();
  }
  // How much of a splash the surface encloses differs by rounding; with the volume deficit it is all there.
  CHECK(b.stats.volume + b.stats.deficit == Approx(a.stats.volume + a.stats.deficit).epsilon(1e-3));
  const Vec3d middle = middleOf(*outside.state().phi);
  // What rounding grows to in the splash: 0.04 to 0.2 of a cell with eight seeds of the markers.
  CHECK((middle + Vec3d(8.0, 0.0, 0.0) - middleOf(*inHall.state().phi)).length() < 0.3 * kVoxel);
  CHECK(middle.x() < -5.0);
  CHECK(middle.y() > 3.0);
  CHECK(middle.z() < 0.25);
}

TEST_CASE("unbounded: what is known of solids follows the liquid and no more", "[sim]") {
  Options options = ballAt(Vec3d(0.5), Vec3d(0.0), Side::unbounded);
  options.sides[4] = Side::wall;
  options.solids = std::vector<Solid>(1);
  options.solids[0].shape = {Cylinder{Vec3d(-40.0, 0.5, -1.0), Vec3d(-40.0, 0.5, 1.0), 0.3}};
  Solids solids(options);
  CHECK(solids.warnings().empty());
  const auto ball = [&](const Vec3d& at) {
    FloatGrid::Ptr phi = makePhi(kVoxel, 6.0 * kVoxel);
    unite(*phi, ShapeDistance({Sphere{at, 0.25}}, kVoxel), domainCells(options));
    return phi;
  };
  const auto here = ball(Vec3d(0.5)), little = ball(Vec3d(0.7)), there = ball(Vec3d(-40.0, 0.8, 0.5));
  const auto first = solids.around({here.get()}, 0.0, {0});
  CHECK(solids.around({little.get()}, 0.0, {0}) == first);  // what is made lasts for a while
  const auto second = solids.around({there.get()}, 0.0, {0});
  CHECK(second != first);
  CHECK(first->phi->constTree().leafCount() < 1500);
  CHECK(second->phi->constTree().leafCount() < 1500);

  const Coord floor(-640, 30, -1), inPost(-640, 8, 8), beside(-640, 24, 8);
  CHECK(second->phi->constTree().getValue(floor) < 0.0f);
  CHECK(second->phi->constTree().getValue(inPost) < 0.0f);
  CHECK(second->phi->constTree().getValue(beside) > 0.0f);
  CHECK(second->open[2].constTree().getValue(Coord(-640, 24, 0)) == 0.0f);
  CHECK(second->open[2].constTree().getValue(Coord(-640, 24, 1)) == 1.0f);
  CHECK(second->open[0].constTree().getValue(inPost) == 0.0f);
}

TEST_CASE("unbounded: floors are found where the domain goes on to them", "[sim]") {
  Options options;
  options.resolution = 16;
  options.sides.fill(Side::unbounded);
  options.solids = std::vector<Solid>(2);
  options.solids[0].shape = {HalfSpace{Vec3d(0.0, 0.0, -3.0), Vec3d(0.0, 0.0, 1.0)}};
  options.solids[1].shape = {Box{Vec3d(200.0, -9.0, -2.0), Vec3d(202.0, 9.0, 2.0)}};
  CHECK(Solids(options).warnings().empty());
  options.solids[1].shape = {Box{Vec3d(200.0, -9.0, -2.0), Vec3d(200.01, 9.0, 2.0)}};
  CHECK(Solids(options).warnings().size() == 1);
  options.sides[4] = Side::wall;
  CHECK(Solids(options).warnings().size() == 2);
}

TEST_CASE("unbounded: along the edge between two walls phi follows the liquid and no more", "[sim]") {
  // A quarter of a ball that lies in the edge.
  Options options = ballAt(Vec3d(0.5, 0.0, 0.0), Vec3d(0.0), Side::unbounded);
  options.sides[2] = options.sides[4] = Side::wall;
  Solver solver(options);
  for (int n = 0; n < 12; ++n) solver.next();
  openvdb::CoordBBox leaves;
  REQUIRE(solver.state().phi->constTree().evalLeafBoundingBox(leaves));
  CHECK(leaves.min().x() >= -8);
  CHECK(leaves.max().x() < 24);
  CHECK(leaves.max().y() < 16);
  CHECK(leaves.max().z() < 16);
}

TEST_CASE("unbounded: goes on from a state as if it had not stopped", "[sim][slow]") {
  // Thick liquid that sticks to the floor on its way, with a rotor in it.
  Options options = ballAt(Vec3d(0.5, 0.5, 0.25), Vec3d(-8.0, 0.0, 0.0), Side::unbounded);
  options.sides[4] = Side::wall;
  options.gravity = Vec3d(0.0, 0.0, -9.81);
  options.viscosity = 4.0;
  options.walls = {{DomainFace::zLow, {.kind = WallKind::friction, .slipLength = 0.1}}};
  options.solids = std::vector<Solid>(1);
  options.solids[0].shape = {Box{Vec3d(-3.0, 0.4, 0.1), Vec3d(1.0, 0.6, 0.2)}};
  options.solids[0].pivot = Vec3d(-1.0, 0.5, 0.0);
  options.solids[0].keyframes = {{.time = 0.0}, {.time = 1.0, .turn = 90.0}};
  Solver whole(options);
  for (int n = 0; n < 4; ++n) whole.next();
  Solver restored(options, whole.state());
  for (int n = 0; n < 3; ++n) {
    const Frame a = whole.next(), b = restored.next();
    CHECK(a.substeps.size() == b.substeps.size());
  }
  CHECK(holdsAll(*whole.state().phi, *restored.state().phi));
  CHECK(holdsAll(*whole.state().velocity.component[0], *restored.state().velocity.component[0]));
}

TEST_CASE("unbounded: liquid without an end is refused", "[sim]") {
  Options options;
  options.sides[1] = Side::unbounded;
  options.liquid = {{Shape{HalfSpace{Vec3d(0.0, 0.0, 0.3), Vec3d(0.0, 0.0, 1.0)}}, Vec3d(0.0), 0.0}};
  CHECK_THROWS_AS(Solver(options).next(), std::invalid_argument);
  // Between walls it ends.
  options.liquid[0].shape = {HalfSpace{Vec3d(0.3, 0.0, 0.0), Vec3d(1.0, 0.0, 0.0)}};
  options.resolution = 16;
  CHECK(std::abs(Solver(options).next().stats.volume - 0.3) < 0.01);
}
