#include "tools/benchmarks/peers/poisson.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::benchmarks;
using Catch::Contains;

namespace {

// Both solve the problem to the tolerance, `bound` times as far at most, and find the same.
void checkSame(const PoissonProblem& problem, const Solved& ours, const Solved& peer, double bound) {
  CHECK(peer.failed.empty());
  REQUIRE(peer.x.size() == problem.b.size());
  CHECK(peer.iterations > 0);
  CHECK(peer.setup >= 0.0);
  CHECK(peer.solve > 0.0);
  CHECK(residualOf(problem, peer.x) <= bound * kTolerance);
  double largest = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < peer.x.size(); ++i) {
    largest = std::max(largest, std::abs(ours.x[i]));
    apart = std::max(apart, std::abs(ours.x[i] - peer.x[i]));
  }
  CHECK(apart < 1e-4 * largest);
}

}  // namespace

TEST_CASE("poisson peers: whoever solves the box finds the same", "[benchmarks]") {
  const PoissonProblem problem = boxProblem(16);
  const Solved ours = solveOurs(problem);
  SECTION("Eigen") {
    checkSame(problem, ours, solveEigen(problem), 1.001);
  }
  // It stops on the largest error, not on the 2-norm.
  SECTION("OpenVDB") {
    checkSame(problem, ours, solveOpenvdb(problem), 10.0);
  }
  SECTION("hypre") {
    const Solved hypre = solveHypre(problem);
    if (hypre.failed.empty()) {
      checkSame(problem, ours, hypre, 1.001);
    } else {
      CHECK_THAT(hypre.failed, Contains("libhypre-dev"));
      WARN("hypre is not there");
    }
  }
}

TEST_CASE("poisson peers: the liquid of a dam break, by the one that takes any cells", "[benchmarks]") {
  const PoissonProblem problem = damBreakProblem(20, 1);
  checkSame(problem, solveOurs(problem), solveEigen(problem), 1.001);
}
