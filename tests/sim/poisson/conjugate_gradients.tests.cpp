#include "sim/poisson/conjugate_gradients.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr std::int32_t kUnknowns = 50;

struct Report {
  int iterations = 0;
  double residual = 1.0;
  bool converged = false;
};

// A chain of springs of different strength, both of whose ends are tied, and the forces that draw it to x =
// i^2.
struct Chain {
  std::vector<double> x = std::vector<double>(kUnknowns, 0.0);
  ConjugateGradients vectors;

  Chain() : vectors{.n = kUnknowns, .x = x} {
    std::vector<double> wanted(kUnknowns);
    for (std::int32_t i = 0; i < kUnknowns; ++i) wanted[i] = target(i);
    vectors.p = wanted;
    vectors.q.assign(kUnknowns, 0.0);
    product();
    vectors.r = vectors.q;
    vectors.p.assign(kUnknowns, 0.0);
    vectors.scaled.resize(kUnknowns);
    vectors.z.resize(kUnknowns);
    vectors.rightNorm = vectors.residualNorm =
        std::sqrt(sumOver(kUnknowns, [&](std::int32_t i) { return vectors.r[i] * vectors.r[i]; }));
  }

  static double target(std::int32_t i) { return double(i) * i; }
  static double spring(std::int32_t i) { return 1.0 + i % 7; }

  double product() {
    double sum = 0.0;
    for (std::int32_t i = 0; i < kUnknowns; ++i) {
      const double before = i > 0 ? vectors.p[i - 1] : 0.0;
      const double after = i + 1 < kUnknowns ? vectors.p[i + 1] : 0.0;
      vectors.q[i] = spring(i) * (vectors.p[i] - before) + spring(i + 1) * (vectors.p[i] - after);
      sum += vectors.p[i] * vectors.q[i];
    }
    return sum;
  }

  template <class GoesOn>
  Report solve(double tolerance, int maxIterations, const GoesOn& goesOn) {
    Report report;
    conjugateGradients(
        vectors, tolerance, maxIterations,
        [&] {
          for (std::int32_t i = 0; i < kUnknowns; ++i)
            vectors.z[i] = vectors.scaled[i] / float(spring(i) + spring(i + 1));
        },
        [&] { return product(); }, goesOn, report);
    return report;
  }
};

}  // namespace

TEST_CASE("conjugate gradients: to single precision in as many steps as unknowns, and on to double's",
          "[sim][poisson]") {
  const Report single = Chain().solve(1e-5, kUnknowns, [] { return true; });
  CHECK(single.converged);
  CHECK(single.residual <= 1e-5);
  Chain chain;
  CHECK(chain.solve(1e-10, 2 * kUnknowns, [] { return true; }).converged);
  for (std::int32_t i = 0; i < kUnknowns; ++i) CHECK(chain.x[i] == Approx(Chain::target(i)).margin(1e-5));
}

TEST_CASE("conjugate gradients: end where they are told to", "[sim][poisson]") {
  CHECK(Chain().solve(1e-10, 3, [] { return true; }).iterations == 3);
  int asked = 0;
  const Report report = Chain().solve(1e-10, 100, [&] { return ++asked < 4; });
  CHECK(report.iterations == 4);
  CHECK_FALSE(report.converged);
  // At the solution nothing is asked any more.
  asked = 0;
  const Report rough = Chain().solve(2.0, 100, [&] { return ++asked < 0; });
  CHECK((rough.converged && rough.iterations == 1 && asked == 0));
}
