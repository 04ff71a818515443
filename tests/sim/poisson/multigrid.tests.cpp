#include "sim/poisson/multigrid.h"

#include "tests/sim/poisson/poisson_box.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("multigrid: symmetric and positive", "[sim]") {
  const PoissonSystem system = systemOf(21, twoRooms);
  const int n = system.numbering.size();
  Multigrid multigrid(system, EvenRows(system.rows, system.anchor));
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<float> a(n + 1, 0.0f), b(n + 1, 0.0f), ma(n + 1, 0.0f), mb(n + 1, 0.0f);
  for (int i = 0; i < n; ++i) {
    a[i] = uniform(random);
    b[i] = uniform(random) + 0.5f;
  }
  multigrid.apply(a, ma);
  multigrid.apply(b, mb);
  double ab = 0.0, ba = 0.0, aa = 0.0;
  for (int i = 0; i < n; ++i) {
    ab += double(a[i]) * mb[i];
    ba += double(b[i]) * ma[i];
    aa += double(a[i]) * ma[i];
  }
  CHECK(aa > 0.0);
  CHECK_THAT(ab, WithinAbs(ba, 1e-4 * aa));
}

TEST_CASE("multigrid: a cycle is near the inverse, on large grids as on small ones", "[sim]") {
  for (const int n : {8, 40}) {
    const PoissonSystem system = systemOf(n, everywhere);
    const int size = system.numbering.size();
    Multigrid multigrid(system, EvenRows(system.rows, system.anchor));
    // x, and A x, with A as in PoissonRows.
    std::vector<float> x(size + 1, 0.0f), b(size + 1, 0.0f), found(size + 1, 0.0f);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (int i = 0; i < size; ++i) x[i] = uniform(random);
    for (int i = 0; i < size; ++i) {
      double sum = system.anchor[i] * x[i];
      for (int s = 0; s < kSides; ++s) sum += system.rows.link[i][s] * (x[i] - x[system.rows.neighbor[i][s]]);
      b[i] = static_cast<float>(sum);
    }
    multigrid.apply(b, found);
    // In the norm of A one cycle leaves less than half of the error.
    double left = 0.0, all = 0.0;
    for (int i = 0; i < size; ++i) {
      const auto energy = [&](const auto& at) {
        double sum = 0.5 * system.anchor[i] * at(i) * at(i);
        for (int s = 0; s < kSides; ++s) {
          const double step = at(i) - at(system.rows.neighbor[i][s]);
          if (system.rows.link[i][s] > 0.0f) sum += 0.25 * system.rows.link[i][s] * step * step;
        }
        return sum;
      };
      left += energy([&](int j) { return double(found[j]) - x[j]; });
      all += energy([&](int j) { return double(x[j]); });
    }
    CAPTURE(n, left / all);
    CHECK(left < 0.25 * all);
  }
}
