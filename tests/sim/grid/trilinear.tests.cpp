#include "sim/grid/velocity_window.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

// Trilinear: what the interpolation reproduces, cross terms included.
double field(int component, const Vec3d& x) {
  return 1.0 + component + 0.5 * x[0] - 0.25 * x[1] + 2.0 * x[2] + 0.125 * x[0] * x[1] +
         0.25 * (component + 1) * x[1] * x[2] - 0.1 * x[0] * x[1] * x[2];
}

}  // namespace

TEST_CASE("trilinear: reproduces trilinear fields, each component of a staggered block at its own place") {
  constexpr int kSide = 6;
  std::vector<float> block[3];
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        for (int k = 0; k < kSide; ++k) {
          Vec3d x(i, j, k);
          x[c] -= 0.5;
          block[c].push_back(static_cast<float>(field(c, x)));
        }
      }
    }
  }
  const StaggeredBlocks blocks{{block[0].data(), block[1].data(), block[2].data()}, kSide};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0.0f, 4.4f);
  for (int n = 0; n < 100; ++n) {
    const Vec3d x(place(random), place(random), place(random));
    const Lanes here = lanes(float(x[0]), float(x[1]), float(x[2])), other = lanes(float(x[2]), 0.3f, 1.7f);
    const Lanes all = firstOf(blocks.at(pairs(here, here)));
    CHECK_THAT(lane0(all), WithinAbs(field(0, x), 1e-4));
    CHECK_THAT(lane1(all), WithinAbs(field(1, x), 1e-4));
    CHECK_THAT(lane2(all), WithinAbs(field(2, x), 1e-4));
    // The same beside another place, to the last bit.
    const Lanes first = firstOf(blocks.at(pairs(here, other))),
                second = secondOf(blocks.at(pairs(other, here)));
    CHECK((_mm_movemask_ps(_mm_cmpeq_ps(first, all)) & 7) == 7);
    CHECK((_mm_movemask_ps(_mm_cmpeq_ps(second, all)) & 7) == 7);
    // One component alone, at the same place.
    const Vec3d shifted = x + Vec3d(0.5, 0.0, 0.0);
    const int i = int(shifted[0]), j = int(shifted[1]), k = int(shifted[2]);
    const float one = trilinear(block[0].data() + (i * kSide + j) * kSide + k, kSide * kSide, kSide,
                                float(shifted[0] - i), float(shifted[1] - j), float(shifted[2] - k));
    CHECK_THAT(one, WithinAbs(field(0, x), 1e-4));
  }
}

TEST_CASE("tricubic: reproduces polynomials of third degree along each axis") {
  const auto along = [](double a, double b, double c, double d, double x) {
    return a + x * (b + x * (c + x * d));
  };
  const auto polynomial = [&](const Vec3d& x) {
    return along(1.0, -0.4, 0.3, -0.05, x[0]) * along(0.5, 0.2, -0.1, 0.04, x[1]) *
           along(-0.7, 0.6, 0.2, -0.03, x[2]);
  };
  constexpr int kSide = 5;
  std::vector<float> block;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      for (int k = 0; k < kSide; ++k) block.push_back(static_cast<float>(polynomial(Vec3d(i, j, k))));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0.0f, 1.0f);
  for (int n = 0; n < 100; ++n) {
    const Vec3d t(place(random), place(random), place(random));
    const float value = tricubic(block.data() + (1 * kSide + 1) * kSide + 1, kSide * kSide, kSide,
                                 float(t[0]), float(t[1]), float(t[2]));
    CHECK_THAT(value, WithinAbs(polynomial(Vec3d(1.0) + t), 1e-5));
  }
}

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
