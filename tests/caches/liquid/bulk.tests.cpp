#include "caches/liquid/bulk.h"

#include "caches/liquid/explained.h"
#include "caches/liquid/level_set.h"
#include "sim/grid/mac_grid.h"
#include "tests/caches/liquid/flows.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Coord;

namespace {

constexpr double kCell = 0.01;

// A box, the distances to which are negative within.
struct Box {
  Vec3d low, high;

  double distance(const Vec3d& x) const {
    Vec3d outside(0.0);
    double deepest = -1e30;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max(low[axis] - x[axis], x[axis] - high[axis]);
      outside[axis] = std::max(d, 0.0);
      deepest = std::max(deepest, d);
    }
    return deepest > 0.0 ? outside.length() : deepest;
  }
};

// Level set of all that one of the shapes covers.
template <class Shape>
openvdb::FloatGrid::Ptr phiOf(const std::vector<Shape>& shapes) {
  openvdb::initialize();
  const auto phi = openvdb::createLevelSet<openvdb::FloatGrid>(kCell, kBand);
  phi->setTransform(sim::cellTransform(kCell));
  const double band = kBand * kCell;
  for (auto at = openvdb::CoordBBox(Coord(-10), Coord(100, 60, 60)).begin(); at; ++at) {
    double d = band;
    for (const Shape& shape : shapes) d = std::min(d, shape.distance(phi->indexToWorld(*at)));
    if (std::abs(d) < band)
      phi->tree().setValue(*at, float(d));
    else if (d < 0.0)
      phi->tree().setValueOff(*at, float(-band));
  }
  return phi;
}

// Share of the bulk among the points of the surface whose x lies between.
template <class Shape>
double bulkShare(const std::vector<Shape>& shapes, double from = -1.0, double to = 2.0) {
  const auto phi = phiOf(shapes);
  std::vector<Vec3d> points = surfacePoints(*phi, 20000);
  std::erase_if(points, [&](const Vec3d& x) { return x[0] < from || x[0] > to; });
  REQUIRE(points.size() > 100);
  const std::vector<bool> bulk = isInBulk(*phi, points);
  return double(std::count(bulk.begin(), bulk.end(), true)) / double(points.size());
}

const Box kBlock{Vec3d(0.003), Vec3d(0.403)};

// A block, and a sheet that goes on from its middle.
std::vector<Box> blockWithSheet(double thickness) {
  return {kBlock, {Vec3d(0.303, 0.003, 0.15), Vec3d(0.803, 0.403, 0.15 + thickness)}};
}

std::vector<Box> twoBlocks(double gap) {
  return {kBlock, {Vec3d(0.403 + gap, 0.003, 0.003), Vec3d(0.803 + gap, 0.403, 0.403)}};
}

}  // namespace

TEST_CASE("bulk: all of a block and of a large ball, its edges and corners too", "[caches]") {
  CHECK(bulkShare(std::vector<Box>{kBlock}) == 1.0);
  CHECK(bulkShare(std::vector<Ball>{{Vec3d(0.25), 0.2}}) == 1.0);
}

TEST_CASE("bulk: nothing of a drop or a sheet that is thin", "[caches]") {
  CHECK(bulkShare(std::vector<Ball>{{Vec3d(0.25), 0.9 * kThin / 2 * kCell}}) == 0.0);
  CHECK(bulkShare(std::vector<Box>{{Vec3d(0.003), Vec3d(0.403, 0.403, 0.003 + 0.5 * kThin * kCell)}}) == 0.0);
}

TEST_CASE("bulk: what is near a thin sheet is left out, the rest of a block is not", "[caches]") {
  const double sheetFrom = 0.403, clear = (kClear + 2) * kCell;
  const std::vector<Box> thin = blockWithSheet(0.5 * kThin * kCell);
  CHECK(bulkShare(thin, -1.0, sheetFrom - clear) == 1.0);
  CHECK(bulkShare(thin, sheetFrom - 0.5 * clear, sheetFrom + kCell) < 1.0);
  CHECK(bulkShare(thin, sheetFrom + kThin * kCell) == 0.0);
  CHECK(bulkShare(blockWithSheet(1.5 * kThin * kCell)) == 1.0);
}

TEST_CASE("bulk: what is near a thin gap of air is left out as well", "[caches]") {
  const double gap = 0.5 * kThin * kCell, clear = (kClear + 2) * kCell;
  CHECK(bulkShare(twoBlocks(gap), 0.39, 0.41) == 0.0);
  CHECK(bulkShare(twoBlocks(gap), -1.0, 0.403 - clear) == 1.0);
  CHECK(bulkShare(twoBlocks(1.5 * kThin * kCell)) == 1.0);
}
