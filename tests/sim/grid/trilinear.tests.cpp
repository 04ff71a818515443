#include "sim/grid/trilinear.h"

#include "sim/vec3.h"

#include <catch2/catch.hpp>

#include <random>
#include <vector>

using namespace fluidtex;
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
    const Float4 here = float4(float(x[0]), float(x[1]), float(x[2])),
                 other = float4(float(x[2]), 0.3f, 1.7f);
    const Float4 all = low4(blocks.at(joined8(here, here)));
    CHECK_THAT(all[0], WithinAbs(field(0, x), 1e-4));
    CHECK_THAT(all[1], WithinAbs(field(1, x), 1e-4));
    CHECK_THAT(all[2], WithinAbs(field(2, x), 1e-4));
    // The same beside another place, to the last bit.
    const Float4 first = low4(blocks.at(joined8(here, other))),
                 second = high4(blocks.at(joined8(other, here)));
    for (int a = 0; a < 3; ++a) CHECK((first[a] == all[a] && second[a] == all[a]));
    // One component alone, at the same place.
    const Vec3d shifted = x + Vec3d(0.5, 0.0, 0.0);
    const int i = int(shifted[0]), j = int(shifted[1]), k = int(shifted[2]);
    const float one = trilinear(block[0].data() + (i * kSide + j) * kSide + k, kSide * kSide, kSide,
                                float(shifted[0] - i), float(shifted[1] - j), float(shifted[2] - k));
    CHECK_THAT(one, WithinAbs(field(0, x), 1e-4));
  }
}
