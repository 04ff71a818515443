#include "sim/surface/poured_surface.h"

#include "sim/solids/domain.h"
#include "sim/solids/solids.h"
#include "sim/surface/level_set.h"
#include "tests/sim/step/solver_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr double kVoxel = 1.0 / 16;

std::function<double(const Vec3d&)> surfaceOf(const Options& options) {
  const Solids solids(options);
  const auto walls = std::make_shared<Solids>(options);
  return pouredSurface(
      ShapeDistance(options.liquid[0].shape, kVoxel, domainBox(options)),
      [walls](const Vec3d& x) { return walls->distance(x, 0.0); }, kVoxel);
}

}  // namespace

TEST_CASE("poured surface: level up to a wall, however near the wall is to a cell's centre") {
  for (const double into : {0.0, 0.03, -0.03, 0.3, 0.7, 1.5}) {  // beyond the wall, in cells; or before it
    Options options = tank(16, {});
    options.solids.resize(1);
    const double wall = (10.0 + 0.52) * kVoxel;  // just beyond the centres of cells 10
    options.solids[0].shape = {Box{Vec3d(wall, -1.0, -1.0), Vec3d(2.0)}};
    options.liquid.resize(1);
    options.liquid[0].shape = {Box{Vec3d(0.0), Vec3d(wall + into * kVoxel, 1.0, 0.45)}};
    const auto surface = surfaceOf(options);
    CAPTURE(into);
    for (int k = 6; k < 8; ++k) {  // one below the surface, one above
      const Vec3d x = (Vec3d(10, 8, k) + Vec3d(0.5)) * kVoxel;
      CHECK(surface(x) / kVoxel == Catch::Detail::Approx((x[2] - 0.45) / kVoxel).margin(1e-3));
    }
    CHECK(surface((Vec3d(10, 8, 2) + Vec3d(0.5)) * kVoxel) < 0.0);  // deep below
  }
}

TEST_CASE("poured surface: cells whose centres a wall goes through are liquid, however it is rounded") {
  // A corner of the wall and one that is a quarter of a cell away.
  const double centre = 10.5 * kVoxel, side = 8.25 * kVoxel, level = 7.2 * kVoxel;
  for (const double wall : {-1e-15, 0.0, 1e-15}) {
    for (const double end : {-1e-15, 0.0, 1e-15}) {
      Options options = tank(16, {});
      options.solids.resize(2);
      options.solids[0].shape = {Box{Vec3d(centre + wall, -1.0, -1.0), Vec3d(2.0)}};
      options.solids[1].shape = {Box{Vec3d(-1.0), Vec3d(2.0, side, 2.0)}};
      options.liquid.resize(1);
      options.liquid[0].shape = {Box{Vec3d(0.0, side, 0.0), Vec3d(centre + end, 1.0, level)}};
      CAPTURE(wall, end);
      const auto surface = surfaceOf(options);
      for (const int j : {8, 9, 12}) {
        CAPTURE(j);
        CHECK(surface((Vec3d(10, j, 2) + Vec3d(0.5)) * kVoxel) < -kVoxel);
        for (const int k : {6, 7}) {
          const Vec3d x = (Vec3d(10, j, k) + Vec3d(0.5)) * kVoxel;
          CHECK(surface(x) / kVoxel == Approx((x[2] - level) / kVoxel).margin(1e-3));
        }
      }
    }
  }
}

TEST_CASE(
    "poured surface: at the foot of solids that stand in the floor the liquid is as deep as elsewhere") {
  const Vec3d foot(7.3 * kVoxel, 8.4 * kVoxel, 2.3 * kVoxel);
  for (const Shape& shape : {Shape{Sphere{foot, 3.75 * kVoxel}},
                             Shape{Cylinder{foot, foot + Vec3d(2.0, 1.0, 0.4) * kVoxel, 3.75 * kVoxel}}}) {
    Options options = tank(16, {});
    options.solids.resize(1);
    options.solids[0].shape = shape;
    options.liquid.resize(1);
    options.liquid[0].shape = {Box{Vec3d(0.0), Vec3d(1.0, 1.0, 12.0 * kVoxel)}};
    const auto surface = surfaceOf(options);
    Solids solids(options);
    int count = 0;
    for (int n = 0; n < 16 * 16 * 9; ++n) {
      const Vec3d x = (Vec3d(n % 16, n / 16 % 16, n / 256) + Vec3d(0.5)) * kVoxel;
      if (solids.distance(x, 0.0) < 0.0) continue;
      ++count;
      CAPTURE(n % 16, n / 16 % 16, n / 256);
      CHECK(surface(x) < -1.7 * kVoxel);
    }
    CHECK(count > 2000);
  }
}

TEST_CASE("poured surface: a slope keeps its distance at a wall") {
  Options options = tank(16, {});
  options.liquid.resize(1);
  const Vec3d normal = Vec3d(0.3, 0.1, 1.0).unit();
  options.liquid[0].shape = {HalfSpace{Vec3d(0.5), normal}};
  const auto surface = surfaceOf(options);
  for (int i = 0; i < 16; i += 15)
    for (int j = 0; j < 16; ++j)
      for (int k = 4; k < 12; ++k) {
        const Vec3d x = (Vec3d(i, j, k) + Vec3d(0.5)) * kVoxel;
        const double exact = normal.dot(x - Vec3d(0.5));
        if (std::abs(exact) < 0.5 * kVoxel) CHECK(surface(x) == Catch::Detail::Approx(exact).margin(1e-6));
      }
}

TEST_CASE("poured surface: liquid that ends at a round or square wall starts level") {
  const Vec3d foot(0.46, 0.44, 0.15), wide(0.25, 0.23, 0.0), up(0.0, 0.0, 1.0);
  for (const bool round : {true, false}) {
    Options options = tank(24, {});
    options.size = Vec3d(0.97, 0.91, 1.0);  // no whole number of cells
    const auto inside = [&](double from, double to) {
      if (round) return Shape{Cylinder{foot + from * up, foot + to * up, 0.23}};
      return Shape{Box{foot - wide + from * up, foot + wide + to * up}};
    };
    options.solids.resize(1);
    options.solids[0].shape = {Difference{{{Box{Vec3d(0.1), Vec3d(0.85)}}, inside(0.05, 1.0)}}};
    options.liquid = {{inside(0.05, 0.4)}};
    Solver solver(options);
    solver.next();
    CAPTURE(round);
    CHECK(fastestOf(solver.state()) < 0.01);
  }
}

TEST_CASE("poured surface: a block that ends less than a cell before a wall keeps its volume") {
  // Cells between the block's top and the ceiling, which lies in the middle of a cell or elsewhere.
  for (const double ceiling : {0.1, 0.42, 0.8}) {
    for (const double gap : {0.2, 0.45, 0.64, 0.9}) {
      Options options = tank(16, {});
      const double h = options.voxelSize();
      options.size[2] = (9.0 + ceiling) * h;
      const Box block{Vec3d(0.2, 0.3, 0.25), Vec3d(0.6, 0.7, options.size[2] - gap * h)};
      options.liquid = {{Shape{block}}};
      const Frame frame = Solver(options).next();
      const Vec3d sides = block.max - block.min;
      CAPTURE(ceiling, gap);
      CHECK(frame.stats.volume + frame.stats.deficit ==
            Catch::Detail::Approx(sides[0] * sides[1] * sides[2]).epsilon(0.025));
    }
  }
}

TEST_CASE("poured surface: a pool stays level round a ball that dips into it") {
  // Cells, from a ball that all but touches the level to half of it.
  for (const double radius : {2.8, 18.0}) {
    for (const double dip : {0.1, 0.4, 0.9, 1.4, 2.8}) {
      Options options = tank(24, {box(Vec3d(0.0), Vec3d(1.0, 1.0, 0.44))});
      options.size = Vec3d(0.97, 0.91, 1.0);
      const double h = options.voxelSize(), r = radius * h, up = 0.44 + r - dip * h;
      // And one that leaves a gap of a cell beside a wall.
      options.solids.resize(2);
      options.solids[0].shape = {Sphere{Vec3d(0.52, 0.47, up), r}};
      options.solids[1].shape = {Sphere{Vec3d(0.97 - r - h, 0.2, up), r}};
      Solver solver(options);
      double fastest = 0.0;
      for (int n = 0; n < 4; ++n) {
        solver.next();
        fastest = std::max(fastest, fastestOf(solver.state()));
      }
      CAPTURE(radius, dip);
      CHECK(fastest < 0.02 * std::sqrt(options.gravity.length() * h));
    }
  }
}

namespace {

// Of liquid in a bath, reaching into its walls as far as to their middle: the fastest in a cell outside
// solids, in sqrt(g h), over some frames. Cells are of one metre.
double fastestInBath(const Vec3d& size, const Box& outside, const Box& inside, double level, int frames) {
  Options options = tank(static_cast<int>(*std::max_element(size.asPointer(), size.asPointer() + 3)), {});
  options.size = size;
  options.frameRate = 5.0;
  const Box room{inside.min, inside.max + Vec3d(0.0, 0.0, 10.0)};
  options.solids.resize(1);
  options.solids[0].shape = {Difference{{{outside}, {room}}}};
  Box filled{0.5 * (outside.min + inside.min), 0.5 * (outside.max + inside.max)};
  filled.min[2] = inside.min[2] - 0.4;
  filled.max[2] = level;
  options.liquid = {{Shape{filled}}};
  Solver solver(options);
  const Solids solids(options);
  double fastest = 0.0;
  for (int n = 0; n < frames; ++n) {
    REQUIRE(solver.next().stats.volume > 200.0);
    const State& state = solver.state();
    for (auto it = state.phi->cbeginValueOn(); it; ++it) {
      const Coord cell = it.getCoord();
      if (*it >= 0.0f || solids.distance(state.phi->indexToWorld(cell), 0.0) <= 0.0) continue;
      for (const auto& component : state.velocity.component)
        fastest = std::max(fastest, static_cast<double>(std::abs(component->tree().getValue(cell))));
    }
  }
  return fastest / std::sqrt(options.gravity.length());
}

}  // namespace

TEST_CASE("poured surface: liquid that ends in the middle of a bath's thin walls is level") {
  // Two thirds of a cell thick. Beyond the edge of the liquid there is air in the plane of its end.
  const Box outside{Vec3d(3.63, 3.94, -1.0), Vec3d(17.85, 13.44, 18.4)};
  const Box inside{Vec3d(4.37, 4.68, 4.16), Vec3d(17.1, 12.7, 18.4)};
  CHECK(fastestInBath(Vec3d(18, 27, 24), outside, inside, 14.35, 4) < 0.02);
}

TEST_CASE("poured surface: liquid stays level a cell below the rim of a bath") {
  // One and a half cells thick; no cell lies deep in them.
  const Box outside{Vec3d(6.7124, 5.77665, 5.9897), Vec3d(12.79775, 23.61335, 13.6472)};
  const Box inside{Vec3d(8.2337, 7.29805, 7.51105), Vec3d(11.2764, 22.092, 13.6472)};
  CHECK(fastestInBath(Vec3d(13, 25, 18), outside, inside, 12.53065, 12) < 0.02);
}

TEST_CASE(
    "poured surface: liquid is level in the corner of a bath, however near a cell's centre is to a wall") {
  const Box outside{Vec3d(3.8, 5.2, 3.2), Vec3d(16.3, 16.6, 22.3)};
  const Box inside{Vec3d(6.6, 8.07, 6.0), Vec3d(13.5044, 13.738, 22.3)};
  CHECK(fastestInBath(Vec3d(29, 21, 28), outside, inside, 13.388, 4) < 0.02);
}

TEST_CASE("poured surface: a pool is level to its rim round a short, inclined cylinder") {
  // The edges of its ends reach between the centres of some cells, by a hundredth of a cell.
  Options options = tank(32, {box(Vec3d(0.0), Vec3d(1.0, 0.5625, 0.356495))});
  options.size = Vec3d(1.0, 0.5625, 0.71875);
  options.solids.resize(1);
  options.solids[0].shape = {
      Cylinder{Vec3d(0.441177, 0.217645, 0.404841), Vec3d(0.378515, 0.170157, 0.319001), 0.107393}};
  Solver solver(options);
  const Solids solids(options);
  const double h = options.voxelSize();
  for (int n = 0; n < 4; ++n) {
    solver.next();
    const State& state = solver.state();
    double farthest = 0.0;  // of phi from the height above the level, in cells
    for (auto it = state.phi->cbeginValueOn(); it; ++it) {
      const Vec3d x = state.phi->indexToWorld(it.getCoord());
      const double height = x[2] - 0.356495;
      if (std::abs(height) < h && solids.distance(x, 0.0) > 0.0)
        farthest = std::max(farthest, std::abs(*it - height) / h);
    }
    REQUIRE(farthest < 0.02);
    REQUIRE(fastestOf(state) < 0.01 * std::sqrt(options.gravity.length() * h));
  }
}

namespace {

// Of liquid in a room of 12 cells of one metre: the fastest beside liquid outside solids in three frames, in
// sqrt(g h).
double fastestInRoom(std::vector<Shape> liquid, std::vector<Shape> solids) {
  Options options = tank(12, {});
  options.size = Vec3d(12.0);
  options.frameRate = 5.0;
  options.viscosity = 0.0;
  for (Shape& shape : liquid) options.liquid.push_back({.shape = std::move(shape)});
  options.solids.resize(solids.size());
  for (std::size_t n = 0; n < solids.size(); ++n) options.solids[n].shape = std::move(solids[n]);
  Solver solver(options);
  double fastest = 0.0;
  for (int n = 0; n < 3; ++n) {
    solver.next();
    fastest = std::max(fastest, fastestOf(solver.state()));
  }
  return fastest / std::sqrt(options.gravity.length());
}

}  // namespace

TEST_CASE("poured surface: liquid that ends at a wall in the plane of cells' centres is level") {
  for (const double level : {5.0, 5.25, 5.5}) {
    for (const double thickness : {0.5, 1.5, 4.0}) {
      for (const double wall : {4.5, 4.25, 4.0}) {
        CAPTURE(level, thickness, wall);
        CHECK(fastestInRoom({{Box{Vec3d(0.0), Vec3d(wall, 12.0, level)}}},
                            {{Box{Vec3d(wall, -1.0, -1.0), Vec3d(wall + thickness, 13.0, 13.0)}}}) < 0.01);
      }
    }
  }
}

TEST_CASE("poured surface: liquid in a basin of five boxes whose corners are cells' centres is level") {
  for (const double wall : {0.5, 1.0, 2.0}) {
    const double low = 2.5, high = 9.5, outer = low - wall, beyond = high + wall;
    CAPTURE(wall);
    CHECK(fastestInRoom({{Box{Vec3d(low), Vec3d(high, high, 5.25)}}},
                        {{Box{Vec3d(outer), Vec3d(beyond, beyond, low)}},
                         {Box{Vec3d(outer, outer, low), Vec3d(low, beyond, 10.0)}},
                         {Box{Vec3d(high, outer, low), Vec3d(beyond, beyond, 10.0)}},
                         {Box{Vec3d(low, outer, low), Vec3d(high, low, 10.0)}},
                         {Box{Vec3d(low, high, low), Vec3d(high, beyond, 10.0)}}}) < 0.01);
  }
}

TEST_CASE("poured surface: bodies that touch are one, wherever the joint between them lies") {
  for (const int axis : {0, 2}) {
    for (const double joint : {4.0, 4.25, 4.5}) {
      for (const double level : {5.0, 5.25}) {
        Vec3d end(12.0, 12.0, level), start(0.0);
        end[axis] = start[axis] = joint;
        const Shape one{Box{Vec3d(0.0), end}}, other{Box{start, Vec3d(12.0, 12.0, level)}};
        CAPTURE(axis, joint, level);
        CHECK(fastestInRoom({one, other}, {}) < 0.03);
        CHECK(fastestInRoom({{Union{{one, other}}}}, {}) < 0.03);
      }
    }
  }
}

TEST_CASE("poured surface: where a body ends in a thin wall there is nothing on the wall's other side") {
  // Cells 8 belong to what is beyond the wall, their centres are 0.3 cells deep. A body goes nearly to the
  // middle, to beyond these centres, or comes out of the wall by 0.3 cells.
  const double low = 7.95 * kVoxel, high = 8.8 * kVoxel;
  for (const double end : {8.3, 8.6, 9.1}) {
    CAPTURE(end);
    Options options = tank(16, {});
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(low, -1.0, -1.0), Vec3d(high, 2.0, 2.0)}};
    Solids solids(options);
    const auto field = solids.at(0.0);
    const ShapeDistance body(Shape{Box{Vec3d(-1.0), Vec3d(end * kVoxel, 2.0, 2.0)}}, kVoxel);
    const FloatGrid::Ptr phi = makePhi(kVoxel, 4.0 * kVoxel);
    unite(*phi, body, domainCells(options));
    const float before = phi->tree().getValue(Coord(8, 8, 8));
    const MaskGrid cleared = clearBehindWalls(*phi, *field, body, solids.distanceAt(0.0));
    const bool comesOut = end > 8.8;
    CHECK(cleared.tree().isValueOn(Coord(8, 8, 8)) == !comesOut);
    CHECK(phi->tree().getValue(Coord(8, 8, 8)) == (comesOut ? before : float(0.5 * kVoxel)));
    CHECK_FALSE(cleared.tree().isValueOn(Coord(7, 8, 8)));
    CHECK_FALSE(cleared.tree().isValueOn(Coord(9, 8, 8)));
  }
}
