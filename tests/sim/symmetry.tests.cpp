#include "sim/solver.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

// A block of water in the middle of a tank of 1 x 0.5 x 0.5 m, or the half of both that lies at low x.
Options collapse(bool lowHalf) {
  Options options;
  options.size = Vec3d(lowHalf ? 0.5 : 1.0, 0.5, 0.5);
  options.resolution = lowHalf ? 16 : 32;
  if (lowHalf) options.sides[1] = Side::symmetry;
  options.liquid = {{Shape{Box{Vec3d(0.3, -1.0, -1.0), Vec3d(0.7, 2.0, 0.4)}}, Vec3d(0.0), 0.0}};
  return options;
}

// Depth of the liquid in a column of cells, in metres.
double depthAt(const State& state, int i, int j) {
  const double h = state.phi->voxelSize()[0];
  double depth = 0.0;
  for (int k = 0; k < 16; ++k)
    depth += h * std::clamp(0.5 - state.phi->tree().getValue(Coord(i, j, k)) / h, 0.0, 1.0);
  return depth;
}

}  // namespace

TEST_CASE("symmetry: half of a collapsing block behaves as in the whole") {
  Solver part(collapse(true)), whole(collapse(false));
  const double h = collapse(true).voxelSize();
  const double start = part.next().stats.volume;
  CHECK(std::abs(2.0 * start / whole.next().stats.volume - 1.0) < 1e-5);
  // Until the water meets the walls.
  for (int n = 2; n <= 6; ++n) {
    part.next();
    whole.next();
    for (int i = 0; i < 16; ++i) {
      INFO("frame " << n << ", column " << i);
      CHECK(std::abs(depthAt(part.state(), i, 8) - depthAt(whole.state(), i, 8)) < 0.25 * h);
    }
  }
}

TEST_CASE("symmetry: liquid lets go of a wall, and not of a side of symmetry") {
  const auto depthAfter = [](Side side) {
    Options options;
    options.resolution = 16;
    options.sides[0] = side;
    options.gravity = Vec3d(9.81, 0.0, 0.0);
    options.liquid = {{Shape{Box{Vec3d(-1.0), Vec3d(0.3, 2.0, 2.0)}}, Vec3d(0.0), 0.0}};
    Solver solver(options);
    for (int n = 0; n < 4; ++n) solver.next();
    return depthAt(solver.state(), 0, 8);
  };
  CHECK(depthAfter(Side::wall) < 0.1);
  CHECK(depthAfter(Side::symmetry) > 0.5);
}
