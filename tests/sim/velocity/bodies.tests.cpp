#include "sim/velocity/bodies.h"

#include "sim/surface/level_set.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr int kCells = 32;

// Three drops between leaves, one of them cut by a plate thinner than a cell, and their bodies.
struct Drops {
  Options options;
  FloatGrid::Ptr phi = makePhi(1.0 / kCells, 6.0 / kCells);

  Drops() {
    options.resolution = kCells;
    Solid plate;
    plate.shape.kind = Box{Vec3d(-1.0, -1.0, 0.745), Vec3d(2.0, 2.0, 0.765)};
    options.solids = {plate};
    for (const Vec3d& centre : {Vec3d(0.02, 0.25, 0.25), Vec3d(0.7, 0.25, 0.3), Vec3d(0.5, 0.7, 0.755)})
      unite(
          *phi, [&](const Vec3d& x) { return (x - centre).length() - 0.15; },
          CoordBBox(Coord(-8), Coord(kCells + 7)));
  }

  Bodies bodies(const std::vector<const FloatGrid*>& openings = {}) const {
    return bodiesOf(*phi, phi->constTree(), *Solids(options).at(0.0), openings);
  }
};

std::int32_t bodyAt(const Bodies& bodies, const Vec3d& x) {
  const Coord cell(Coord::floor(x * kCells));
  for (std::int64_t v = 0; v < static_cast<std::int64_t>(bodies.table.voxels()); ++v)
    if (bodies.table.coord(v) == cell) return bodies.of[v];
  return Bodies::kNone;
}

}  // namespace

TEST_CASE("bodies: what is connected is one, and a thin wall parts them") {
  const Drops drops;
  const Bodies bodies = drops.bodies();
  CHECK(bodies.size() == 4);
  const std::int32_t left = bodyAt(bodies, Vec3d(0.05, 0.25, 0.25)),
                     right = bodyAt(bodies, Vec3d(0.7, 0.25, 0.3)),
                     below = bodyAt(bodies, Vec3d(0.5, 0.7, 0.68)),
                     above = bodyAt(bodies, Vec3d(0.5, 0.7, 0.82));
  CHECK(left != right);
  CHECK(below != above);
  CHECK(std::min({left, right, below, above}) >= 0);
  CHECK(bodyAt(bodies, Vec3d(0.82, 0.27, 0.32)) == right);  // in another leaf
  CHECK(bodyAt(bodies, Vec3d(0.4, 0.25, 0.25)) == Bodies::kNone);
  for (std::size_t v = 0; v < bodies.of.size(); ++v) {
    const Coord cell = bodies.table.coord(static_cast<std::int64_t>(v));
    CHECK((bodies.of[v] == Bodies::kNone || (drops.phi->tree().getValue(cell) < 0.0f && cell[0] >= 0)));
  }
}

TEST_CASE("bodies: a wall holds them along the axis it faces, as far as it covers them") {
  Drops drops;
  const auto free = [&](const Vec3d& x, const std::vector<const FloatGrid*>& openings = {}) {
    const Bodies bodies = drops.bodies(openings);
    return bodies.free[bodyAt(bodies, x)];
  };
  const Vec3d left(0.05, 0.25, 0.25), right(0.7, 0.25, 0.3), below(0.5, 0.7, 0.68);
  CHECK((free(left) - Vec3d(0.0, 1.0, 1.0)).length() < 1e-3);
  CHECK((free(right) - Vec3d(1.0)).length() < 1e-3);
  CHECK((free(below) - Vec3d(1.0, 1.0, 0.0)).length() < 1e-3);

  // A step of a cell and a half along a drop of ten cells: it faces along x and holds little of it.
  Solid step;
  step.shape.kind = Box{Vec3d(-1.0, -1.0, -1.0), Vec3d(0.7, 2.0, 0.3 - 0.15 + 1.5 / kCells)};
  drops.options.solids.push_back(step);
  CHECK(free(right)[0] > 0.8);
  CHECK(free(right)[0] < 0.97);
  CHECK(free(right)[1] > 0.999);
  drops.options.solids.pop_back();

  drops.options.solids[0].wall.kind = WallKind::noSlip;
  CHECK(free(below) == Vec3d(0.0));
  drops.options.sides[0] = Side::symmetry;
  CHECK((free(left) - Vec3d(0.0, 1.0, 1.0)).length() < 1e-3);
  drops.options.sides[0] = Side::open;
  CHECK(free(left) == Vec3d(0.0));
  const FloatGrid::Ptr source = makePhi(1.0 / kCells, 6.0 / kCells);
  unite(
      *source, [](const Vec3d& x) { return (x - Vec3d(0.7, 0.25, 0.3)).length() - 0.1; },
      CoordBBox(Coord(0), Coord(kCells - 1)));
  CHECK(free(right, {source.get()}) == Vec3d(0.0));
}
