#include "sim/grid/velocity_window.h"

#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("velocity window: a trace from a face or a centre is the trace from its place") {
  const double h = 0.1;
  FloatTree topology(0.0f);
  for (int n = 0; n < 27; ++n) {
    FloatLeaf* leaf = topology.touchLeaf(Coord(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1)));
    leaf->setValuesOn();
  }
  const Velocity velocity = velocityField(h, topology, [](const Vec3d& x) {
    return Vec3d(std::sin(3.0 * x[1]) + x[2], std::cos(2.0 * x[0]), x[0] * x[1] - 0.4);
  });
  VelocityWindow window(5);
  window.load(velocity, Coord(0));
  for (int axis = 0; axis < 3; ++axis) {
    for (int offset = 0; offset < kLeafSize; offset += 37) {
      const Vec3f place =
          Vec3f(float(offset >> 6), float((offset >> 3) & 7), float(offset & 7)) + faceShift(axis);
      for (const float step : {-1.7f, 0.9f}) {
        const Vec3f whole = window.trace(place, step);
        const auto [face, other] = window.traceFaces(offset, (offset + 5) % kLeafSize, axis, step);
        CHECK((whole - face).length() < 2e-6f);
        CHECK(other == window.traceFaces((offset + 5) % kLeafSize, 0, axis, step)[0]);
        const auto [low, high] = window.component(axis).range(face);
        const float value = window.component(axis).at(face);
        CHECK(value >= low - 1e-6f);
        CHECK(value <= high + 1e-6f);
        const Vec3f centre = place - faceShift(axis) + Vec3f(0.5f);
        CHECK((window.trace(centre, step) - window.traceCentres(0, offset, step)[1]).length() < 2e-6f);
      }
    }
  }
}

TEST_CASE("velocity window: samples are linear between their own places, clamped at the edge", "[sim]") {
  FloatTree tree(0.0f);
  for (int i = -8; i < 16; ++i)
    for (int j = -8; j < 16; ++j)
      for (int k = -8; k < 16; ++k) tree.setValue(Coord(i, j, k), float(i + 10 * j + 100 * k));
  Window window(3, faceShift(1));
  window.load(tree, Coord(0));
  // The sample (i, j, k) is at (i + 1/2, j, k + 1/2).
  CHECK_THAT(window.at(Vec3f(2.75f, 3.5f, 5.25f)), WithinAbs(2.25 + 35.0 + 475.0, 1e-3));
  CHECK_THAT(window.cubic(Vec3f(2.75f, 3.5f, 5.25f)), WithinAbs(2.25 + 35.0 + 475.0, 1e-3));
  CHECK_THAT(window.at(Vec3f(-20.0f, 3.5f, 5.25f)), WithinAbs(-3.0 + 35.0 + 475.0, 1e-3));
  const auto [low, high] = window.range(Vec3f(2.75f, 3.5f, 5.25f));
  CHECK(low == 2.0f + 30.0f + 400.0f);
  CHECK(high == 3.0f + 40.0f + 500.0f);
}

TEST_CASE("velocity window: the samples around a cell, and the place from its centre", "[sim]") {
  FloatTree tree(0.0f);
  for (int i = -8; i < 16; ++i)
    for (int j = -8; j < 16; ++j)
      for (int k = -8; k < 16; ++k) tree.setValue(Coord(i, j, k), float(i + 100 * j + 10000 * k));
  Window window(4, Vec3f(0.5f));
  window.load(tree, Coord(0));
  Stencil stencil;
  const Vec3f local = window.around(Coord(7, 0, 3), Vec3f(7.75f, 0.5f, 9.0f), stencil);
  CHECK((local - Vec3f(0.25f, 0.0f, 1.5f)).length() < 1e-6f);  // along z it is clamped
  CHECK(stencil[VisibleCells::kMiddle] == 7.0f + 30000.0f);
  CHECK(stencil[VisibleCells::kMiddle + 2 * VisibleCells::kStride[0] - VisibleCells::kStride[1]] ==
        9.0f - 100.0f + 30000.0f);
}

TEST_CASE("velocity window: voxels go in pairs, the last of an odd number with itself", "[sim]") {
  std::vector<std::pair<int, int>> pairs;
  forPairs([](int n) { return n == 3 || n == 64 || n == 511; },
           [&](int a, int b) { pairs.emplace_back(a, b); });
  CHECK(pairs == std::vector<std::pair<int, int>>{{3, 64}, {511, 511}});
}
