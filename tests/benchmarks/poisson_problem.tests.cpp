#include "tools/benchmarks/poisson_problem.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace fluidtex;
using namespace fluidtex::benchmarks;
using sim::Coord;

namespace {

// Two cells beside each other along x, of which the upper one is tied to 0: 1 -1 / -1 2.
PoissonProblem twoCells() {
  PoissonProblem problem;
  sim::CellBlock block;
  block.cells.set(0);
  block.cells.set(64);
  sim::PoissonSystem& system = problem.system;
  system.numbering = sim::CellNumbering({block});
  const int low = system.numbering.at(Coord(0, 0, 0)), high = system.numbering.at(Coord(1, 0, 0));
  system.rows.resize(2);
  for (auto& neighbors : system.rows.neighbor) neighbors.fill(2);
  for (auto& links : system.rows.link) links.fill(0.0f);
  system.rows.neighbor[std::size_t(low)][1] = high;
  system.rows.neighbor[std::size_t(high)][0] = low;
  system.rows.link[std::size_t(low)][1] = system.rows.link[std::size_t(high)][0] = 1.0f;
  system.anchor.assign(2, 0.0);
  system.anchor[std::size_t(high)] = 1.0;
  system.anchoredSides.assign(2, 0);
  system.anchoredSides[std::size_t(high)] = 1 << 1;
  problem.b.assign(2, 0.0);
  problem.b[std::size_t(low)] = 1.0;
  return problem;
}

// By the lower cell's number and the upper one's, whichever comes first.
std::vector<double> inOrder(const PoissonProblem& problem, double low, double high) {
  return problem.system.numbering.at(Coord(0, 0, 0)) == 0 ? std::vector<double>{low, high}
                                                          : std::vector<double>{high, low};
}

// What holds in every system: links are the same from both sides.
void checkSymmetric(const sim::PoissonSystem& system) {
  for (int i = 0; i < system.numbering.size(); ++i)
    for (int s = 0; s < sim::kSides; ++s) {
      const float link = system.rows.link[std::size_t(i)][std::size_t(s)];
      if (link == 0.0f) continue;
      const int there = system.rows.neighbor[std::size_t(i)][std::size_t(s)];
      REQUIRE(there < system.numbering.size());
      REQUIRE(system.rows.neighbor[std::size_t(there)][std::size_t(s ^ 1)] == i);
      REQUIRE(system.rows.link[std::size_t(there)][std::size_t(s ^ 1)] == link);
    }
}

}  // namespace

TEST_CASE("poisson problem: a full box, shut but above, where pressure is 0", "[benchmarks]") {
  const PoissonProblem problem = boxProblem(16);
  const sim::PoissonSystem& system = problem.system;
  CHECK(problem.box == Coord(16, 16, 8));
  REQUIRE(system.numbering.size() == 16 * 16 * 8);
  checkSymmetric(system);
  int links = 0, tied = 0;
  for (int i = 0; i < system.numbering.size(); ++i) {
    const Coord cell = system.numbering.cell(i);
    const bool isTop = cell[2] == 7;
    REQUIRE(system.anchor[std::size_t(i)] == (isTop ? 1.0 : 0.0));
    REQUIRE(int(system.anchoredSides[std::size_t(i)]) == (isTop ? 1 << 5 : 0));
    tied += isTop;
    for (const float link : system.rows.link[std::size_t(i)]) {
      REQUIRE((link == 0.0f || link == 1.0f));
      links += link == 1.0f;
    }
  }
  CHECK(tied == 16 * 16);
  CHECK(links == 2 * (15 * 16 * 8 + 16 * 15 * 8 + 16 * 16 * 7));
}

TEST_CASE("poisson problem: its right-hand side is random, even in [-1, 1], and always the same",
          "[benchmarks]") {
  const PoissonProblem problem = boxProblem(16);
  REQUIRE(problem.b.size() == 2048);
  double sum = 0.0, squares = 0.0;
  for (const double b : problem.b) {
    REQUIRE(std::abs(b) <= 1.0);
    sum += b;
    squares += b * b;
  }
  // Of 2048 even numbers: 0 and 1/3, give or take four standard deviations.
  CHECK(std::abs(sum / 2048.0) < 4.0 * std::sqrt(1.0 / 3.0 / 2048.0));
  CHECK(std::abs(squares / 2048.0 - 1.0 / 3.0) < 4.0 * std::sqrt(4.0 / 45.0 / 2048.0));
  CHECK(boxProblem(16).b == problem.b);
}

TEST_CASE("poisson problem: cells in natural order, x slowest", "[benchmarks]") {
  const PoissonProblem problem = boxProblem(16);
  const std::vector<int> order = naturalOrder(problem.system);
  REQUIRE(order.size() == 2048);
  std::size_t n = 0;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      for (int k = 0; k < 8; ++k) REQUIRE(problem.system.numbering.cell(order[n++]) == Coord(i, j, k));
}

TEST_CASE("poisson problem: the residual is relative to the right-hand side", "[benchmarks]") {
  const PoissonProblem problem = twoCells();
  CHECK(residualOf(problem, {0.0, 0.0}) == 1.0);
  // Low - high = 1, 2 high - low = 0.
  CHECK(residualOf(problem, inOrder(problem, 2.0, 1.0)) == 0.0);
  CHECK(residualOf(problem, inOrder(problem, 1.0, 1.0)) == Approx(std::sqrt(2.0)));
  PoissonProblem larger = problem;
  for (double& b : larger.b) b *= 10.0;
  CHECK(residualOf(larger, inOrder(problem, 10.0, 10.0)) == Approx(std::sqrt(2.0)));
}

TEST_CASE("poisson problem: our solver reaches the tolerance that it says", "[benchmarks]") {
  const PoissonProblem problem = boxProblem(16);
  const Solved solved = solveOurs(problem);
  CHECK(solved.failed.empty());
  REQUIRE(solved.x.size() == problem.b.size());
  CHECK(solved.iterations > 0);
  CHECK(solved.solve > 0.0);
  CHECK(residualOf(problem, solved.x) <= 1.001 * kTolerance);
}

TEST_CASE("poisson problem: our solver finds the pressure of two cells", "[benchmarks]") {
  const PoissonProblem problem = twoCells();
  const Solved solved = solveOurs(problem);
  CHECK(solved.failed.empty());
  REQUIRE(solved.x.size() == 2);
  const std::vector<double> exact = inOrder(problem, 2.0, 1.0);
  for (std::size_t i = 0; i < 2; ++i) CHECK(solved.x[i] == Approx(exact[i]).epsilon(1e-5));
}

TEST_CASE("poisson problem: at first, gravity drives the dam break's liquid into its floor alone",
          "[benchmarks]") {
  // 0.4 x 1 x 0.5 m in cells of a twentieth.
  const PoissonProblem problem = damBreakProblem(20, 1);
  const sim::CellNumbering& numbering = problem.system.numbering;
  REQUIRE(numbering.size() == 8 * 20 * 10);
  REQUIRE(problem.b.size() == 8 * 20 * 10);
  checkSymmetric(problem.system);
  double first = 0.0;
  for (int i = 0; i < numbering.size(); ++i) {
    const double b = problem.b[std::size_t(i)];
    if (numbering.cell(i)[2] > 0) {
      REQUIRE(std::abs(b) < 1e-6);
      continue;
    }
    if (first == 0.0) first = b;
    REQUIRE(b > 0.0);
    REQUIRE(b == Approx(first));
  }
  CHECK(problem.box == Coord(0));
  const Solved solved = solveOurs(problem);
  CHECK(solved.failed.empty());
  CHECK(residualOf(problem, solved.x) <= 1.001 * kTolerance);
}
