#include "tools/benchmarks/poisson_problem.h"

#include "sim/pressure/liquid_cells.h"
#include "sim/pressure/pressure_system.h"
#include "sim/step/solver.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace fluidtex::benchmarks {

using sim::Coord;

PoissonProblem boxProblem(int n) {
  PoissonProblem problem;
  problem.box = Coord(n, n, n / 2);
  std::vector<sim::CellBlock> blocks;
  for (int i = 0; i < n; i += 8) {
    for (int j = 0; j < n; j += 8) {
      for (int k = 0; k < n / 2; k += 8) {
        blocks.push_back({Coord(i, j, k), {}});
        blocks.back().cells.set();
      }
    }
  }
  sim::PoissonSystem& system = problem.system;
  system.numbering = sim::CellNumbering(blocks);
  const int size = system.numbering.size();
  system.rows.resize(size);
  system.anchor.assign(size, 0.0);
  system.anchoredSides.assign(size, 0);
  for (int i = 0; i < size; ++i) {
    const Coord cell = system.numbering.cell(i);
    for (int s = 0; s < sim::kSides; ++s) {
      const int neighbor = system.numbering.at(sim::neighborOf(cell, s));
      system.rows.neighbor[i][s] = neighbor < 0 ? size : neighbor;
      system.rows.link[i][s] = neighbor < 0 ? 0.0f : 1.0f;
    }
    if (cell[2] == problem.box[2] - 1) {
      system.anchor[i] = 1.0;
      system.anchoredSides[i] = 1 << 5;
    }
  }
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  problem.b.resize(size);
  for (const int i : naturalOrder(system)) problem.b[i] = even(random);
  return problem;
}

PoissonProblem damBreakProblem(int resolution, int frames) {
  const sim::Options options = closedDamBreak(resolution);
  sim::Solver solver(options);
  for (int frame = 1; frame <= frames; ++frame) solver.next();
  const sim::State& state = solver.state();
  // What gravity adds in a step is what the pressure takes out again.
  sim::FloatGrid::Ptr w = state.velocity.component[2]->deepCopy();
  for (auto it = w->beginValueOn(); it; ++it)
    it.setValue(*it + static_cast<float>(options.gravity[2] / options.frameRate));
  const auto solid = sim::Solids(options).at(state.time);
  const sim::LiquidCells liquid =
      sim::gatherLiquid(*state.phi, *solid,
                        {&state.velocity.component[0]->constTree(), &state.velocity.component[1]->constTree(),
                         &w->constTree()});
  PoissonProblem problem;
  std::vector<int> liquidOf;
  problem.system =
      sim::pressureSystem(liquid, std::vector<char>(std::size_t(liquid.numbering.size()), 0), liquidOf);
  for (const int cell : liquidOf) problem.b.push_back(-liquid.outflow[cell]);
  return problem;
}

std::vector<int> naturalOrder(const sim::PoissonSystem& system) {
  std::vector<int> order(std::size_t(system.numbering.size()));
  std::iota(order.begin(), order.end(), 0);
  const sim::CellNumbering& numbering = system.numbering;
  std::sort(order.begin(), order.end(), [&](int a, int b) { return numbering.cell(a) < numbering.cell(b); });
  return order;
}

double residualOf(const PoissonProblem& problem, const std::vector<double>& x) {
  double left = 0.0, all = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double r = problem.b[i] - problem.system.anchor[i] * x[i];
    for (int s = 0; s < sim::kSides; ++s) {
      const float link = problem.system.rows.link[i][s];
      if (link > 0.0f) r -= double(link) * (x[i] - x[problem.system.rows.neighbor[i][s]]);
    }
    left += r * r;
    all += problem.b[i] * problem.b[i];
  }
  return std::sqrt(left / all);
}

Solved solveOurs(const PoissonProblem& problem) {
  constexpr int kMostIterations = 200;
  Solved solved;
  const double start = processorSeconds();
  const auto singular = sim::singularParts(problem.system);
  solved.x.assign(problem.b.size(), 0.0);
  const sim::PoissonReport report =
      sim::solvePoisson(problem.system, singular, problem.b, solved.x, kTolerance, kMostIterations);
  solved.solve = processorSeconds() - start;  // with the multigrid's set-up
  solved.iterations = report.iterations;
  if (!report.converged) solved.failed = "our solver did not converge";
  return solved;
}

}  // namespace fluidtex::benchmarks
