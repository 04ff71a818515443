#include "sim/viscosity/volume_fraction.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using sim::negativeShare;

namespace {

// By counting n^3 places.
double counted(double middle, double gx, double gy, double gz, int n) {
  int negative = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5, z = (k + 0.5) / n - 0.5;
        negative += middle + gx * x + gy * y + gz * z < 0.0;
      }
  return double(negative) / (double(n) * n * n);
}

}  // namespace

TEST_CASE("volume fraction: planes across the cube", "[sim]") {
  CHECK(negativeShare(0.0, 1.0, 0.0, 0.0) == Approx(0.5));
  CHECK(negativeShare(0.25, 1.0, 0.0, 0.0) == Approx(0.25).margin(1e-4));
  CHECK(negativeShare(0.25, 0.0, 0.0, -1.0) == Approx(0.25).margin(1e-4));
  CHECK(negativeShare(0.0, 1.0, 1.0, 1.0) == Approx(0.5));
  // A corner: the simplex below x + y + z = 1/2 of the unit cube, 1/48.
  CHECK(negativeShare(1.0, 1.0, 1.0, 1.0) == Approx(1.0 / 48.0));
  CHECK(negativeShare(-1.0, 1.0, 1.0, 1.0) == Approx(47.0 / 48.0));
}

TEST_CASE("volume fraction: all or nothing where the plane passes by", "[sim]") {
  CHECK(negativeShare(-2.0, 1.0, 1.0, 1.0) == 1.0);
  CHECK(negativeShare(2.0, 1.0, 1.0, 1.0) == 0.0);
  CHECK(negativeShare(-1.0, 0.0, 0.0, 0.0) == 1.0);
  CHECK(negativeShare(1.0, 0.0, 0.0, 0.0) == 0.0);
}

TEST_CASE("volume fraction: is what counting gives, for any plane", "[sim]") {
  for (int trial = 0; trial < 40; ++trial) {
    const auto random = [&](int i) { return 2.0 * randomUnit(7, std::uint64_t(4 * trial + i)) - 1.0; };
    const double middle = 0.6 * random(0), gx = random(1), gy = random(2), gz = 0.3 * random(3);
    CHECK(negativeShare(middle, gx, gy, gz) == Approx(counted(middle, gx, gy, gz, 60)).margin(0.01));
    CHECK(negativeShare(middle, gx, gy, gz) + negativeShare(-middle, gx, gy, gz) == Approx(1.0));
  }
}
