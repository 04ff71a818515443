#include "sim/solids/solids.h"
#include "sim/surface/extend_into_solids.h"
#include "sim/surface/level_set.h"
#include "sim/surface/redistance.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

// A slab of 12 layers between two sides of symmetry.
constexpr int kCells = 24, kLayers = 12;
constexpr double kVoxel = 1.0 / kCells;

Options slab() {
  Options options;
  options.size = Vec3d(1.0, 1.0, kLayers * kVoxel);
  options.resolution = kCells;
  options.sides[4] = options.sides[5] = Side::symmetry;
  return options;
}

}  // namespace

TEST_CASE("symmetry: solids end at other sides only, and go on as their mirror image", "[sim]") {
  Options options = slab();
  options.solids = std::vector<Solid>(1);
  options.solids[0].shape = {Sphere{Vec3d(0.5, 0.5, 0.1), 0.2}};
  const auto solid = Solids(options).at(0.0);
  const auto at = [](const FloatGrid& grid, int i, int k) {
    return grid.tree().getValue(Coord(i, kCells / 2, k));
  };
  CHECK(at(*solid->phi, 2, -1) < 0.0f);
  CHECK(at(*solid->phiMirrored, 3, -1) > 0.0f);
  CHECK(at(*solid->phiMirrored, -1, -1) < 0.0f);  // a wall
  CHECK(at(*solid->phiMirrored, 12, 0) < 0.0f);
  for (int i = -2; i < kCells; ++i) {
    for (int k = 0; k < 4; ++k) {
      CHECK(at(*solid->phiMirrored, i, -1 - k) == Approx(at(*solid->phiMirrored, i, k)).margin(1e-6));
      CHECK(at(*solid->phiMirrored, i, kLayers + k) ==
            Approx(at(*solid->phiMirrored, i, kLayers - 1 - k)).margin(1e-6));
    }
  }
  options.sides[4] = options.sides[5] = Side::wall;
  const auto walls = Solids(options).at(0.0);
  CHECK(walls->phiMirrored == walls->phi);
}

TEST_CASE("symmetry: a surface square to the side stays where it is, alike in all layers", "[sim]") {
  const Options options = slab();
  const auto solid = Solids(options).at(0.0);
  const FloatGrid::Ptr phi = makePhi(kVoxel, 6.0 * kVoxel);
  const auto disc = [](const Vec3d& x) { return std::hypot(x.x() - 0.47, x.y() - 0.52) - 0.3; };
  unite(*phi, disc, CoordBBox(Coord(0, 0, -8), Coord(kCells - 1, kCells - 1, kLayers + 7)));
  for (int n = 0; n < 40; ++n) {
    extendBeyond(*phi, *solid);
    redistance(*phi, *solid, 8);
    trimBand(*phi, *solid->phi);
  }
  double farthest = 0.0, unlike = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double exact = disc(phi->indexToWorld(Coord(i, j, 0)));
      if (std::abs(exact) > kVoxel) continue;
      const double middle = phi->tree().getValue(Coord(i, j, kLayers / 2));
      farthest = std::max(farthest, std::abs(middle - exact));
      for (int k = 0; k < kLayers; ++k)
        unlike = std::max(unlike, std::abs(phi->tree().getValue(Coord(i, j, k)) - middle));
    }
  }
  CHECK(farthest < 0.01 * kVoxel);
  CHECK(unlike < 1e-4 * kVoxel);
}
