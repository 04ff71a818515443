#include "sim/poisson/poisson.h"

#include "tests/sim/poisson/poisson_box.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<double> multiplied(const PoissonSystem& system, const std::vector<double>& x) {
  std::vector<double> y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    y[i] = system.anchor[i] * x[i];
    for (int s = 0; s < kSides; ++s) {
      if (system.rows.link[i][s] > 0.0f) {
        y[i] += system.rows.link[i][s] * (x[i] - x[system.rows.neighbor[i][s]]);
      }
    }
  }
  return y;
}

std::vector<double> noise(int size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& value : values) value = uniform(random);
  return values;
}

}  // namespace

TEST_CASE("poisson: the solution is the one that made the right-hand side", "[sim]") {
  const double scale = GENERATE(1e-8, 1.0, 1e8);
  const int n = GENERATE(1, 3, 8, 21);
  CAPTURE(scale, n);
  const PoissonSystem system = systemOf(n, everywhere);
  std::vector<double> exact = noise(system.numbering.size());
  for (double& value : exact) value *= scale;
  std::vector<double> x(exact.size(), 0.0);
  REQUIRE(singularParts(system).empty());
  const PoissonReport report = solvePoisson(system, {}, multiplied(system, exact), x, 1e-12, 200);
  CHECK(report.converged);
  CHECK(report.residual <= 1e-12);
  for (std::size_t i = 0; i < x.size(); ++i) REQUIRE_THAT(x[i], WithinAbs(exact[i], 1e-9 * scale));

  // From the solution there is nothing left to do.
  CHECK(solvePoisson(system, {}, multiplied(system, exact), x, 1e-10, 200).iterations == 0);
}

TEST_CASE("poisson: zero in, zero out, too few iterations are reported", "[sim]") {
  const PoissonSystem system = systemOf(20, everywhere);
  std::vector<double> x(system.numbering.size(), 3.0);
  CHECK(solvePoisson(system, {}, std::vector<double>(x.size(), 0.0), x, 1e-6, 10).converged);
  CHECK(x == std::vector<double>(x.size(), 0.0));
  const PoissonReport report = solvePoisson(system, {}, noise(system.numbering.size()), x, 1e-12, 2);
  CHECK_FALSE(report.converged);
  CHECK(report.iterations == 2);
  CHECK(report.residual > 1e-12);
}

TEST_CASE("poisson: parts without an anchor are found, and solved with mean 0", "[sim]") {
  PoissonSystem system = systemOf(20, twoRooms, false);
  auto parts = singularParts(system);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].size() == 9 * 400);
  CHECK(parts[1].size() == 10 * 400);
  const std::vector<double> exact = noise(system.numbering.size());
  std::vector<double> b = multiplied(system, exact), x(exact.size(), 0.0);
  for (const int i : parts[1]) b[i] += 0.5;  // what no solution can balance is left out
  const PoissonReport report = solvePoisson(system, parts, b, x, 1e-12, 200);
  CHECK(report.converged);
  for (const auto& part : parts) {
    double mean = 0.0, exactMean = 0.0;
    for (const int i : part) {
      mean += x[i] / part.size();
      exactMean += exact[i] / part.size();
    }
    CHECK_THAT(mean, WithinAbs(0.0, 1e-12));
    for (const int i : part) REQUIRE_THAT(x[i], WithinAbs(exact[i] - exactMean, 1e-8));
  }
  system.anchor[parts[0].front()] = 1.0;
  CHECK(singularParts(system).size() == 1);
}

TEST_CASE("cell numbering: red before black, each cell found again", "[sim]") {
  std::vector<CellBlock> blocks(2);
  blocks[0].origin = Coord(0, 0, 8);
  blocks[1].origin = Coord(8, 0, 0);
  for (int c = 0; c < 512; c += 3) blocks[0].cells.set(c);
  for (int c = 0; c < 512; c += 7) blocks[1].cells.set(c);
  const CellNumbering numbering(blocks);
  REQUIRE(numbering.size() == static_cast<int>(blocks[0].cells.count() + blocks[1].cells.count()));
  for (int i = 0; i < numbering.size(); ++i) {
    const Coord c = numbering.cell(i);
    CHECK((((c[0] + c[1] + c[2]) & 1) == 0) == (i < numbering.redCount()));
    CHECK(numbering.at(c) == i);
  }
  CHECK(numbering.at(Coord(0, 0, 9)) == -1);
  CHECK(numbering.at(Coord(-1, 0, 8)) == -1);
  CHECK(numbering.at(Coord(0, 0, 16)) == -1);
  CHECK(numbering.at(Coord(8, 0, 8)) == -1);  // a block without cells
}

TEST_CASE("cell numbering: blocks far apart, on both sides of 0", "[sim]") {
  std::vector<CellBlock> blocks(3);
  blocks[0].origin = Coord(-40000, -8, 16);
  blocks[1].origin = Coord(-8, -32000, -8);
  blocks[2].origin = Coord(0, 0, 0);
  for (CellBlock& block : blocks) block.cells.set(511).set(0);
  const CellNumbering numbering(blocks);
  REQUIRE(numbering.size() == 6);
  for (int i = 0; i < 6; ++i) CHECK(numbering.at(numbering.cell(i)) == i);
  CHECK(numbering.at(Coord(-1, -31993, -1)) >= 0);
  CHECK(numbering.at(Coord(-1, -1, -1)) == -1);
  CHECK(numbering.at(Coord(-2000000000, 2000000000, 0)) == -1);
  CHECK(CellNumbering(std::vector<CellBlock>()).at(Coord(0)) == -1);
}

TEST_CASE("even rows: cover the range once, and only where all links are alike and no anchor is", "[sim]") {
  PoissonRows rows;
  rows.resize(200);
  std::vector<double> anchor(200, 0.0);
  for (auto& link : rows.link) link.fill(2.0f);
  rows.link[40][3] = 1.0f;
  anchor[130] = 0.5;
  const EvenRows even(rows, anchor);
  std::vector<int> evenly(200, 0), mixed(200, 0);
  even.forParts(
      5, 200,
      [&](int first, int last, float link) {
        CHECK(link == 2.0f);
        for (int i = first; i < last; ++i) ++evenly[i];
      },
      [&](int first, int last) {
        for (int i = first; i < last; ++i) ++mixed[i];
      });
  for (int i = 0; i < 200; ++i) CHECK(evenly[i] + mixed[i] == (i < 5 ? 0 : 1));
  CHECK(mixed[40] == 1);
  CHECK(mixed[130] == 1);
  CHECK(evenly[10] == 1);
  CHECK(evenly[199] == 1);
}
