// Pressure systems that solvers are compared on, and how ours solves them; peers: peers/poisson.h.
#pragma once

#include "sim/poisson/poisson.h"

#include <string>
#include <vector>

namespace fluidtex::benchmarks {

struct PoissonProblem {
  sim::PoissonSystem system;
  std::vector<double> b;
  sim::Coord box{0};  // its cells along each axis; (0, 0, 0) where they are no box
};

// A full box of n x n x n / 2 cells, n a multiple of 16: five walls, and pressure 0 in the centres of the
// cells above. The right-hand side is random, even in [-1, 1].
PoissonProblem boxProblem(int n);

// The liquid of the closed dam break, as the solver meets it after `frames` frames.
PoissonProblem damBreakProblem(int resolution, int frames);

// Relative to the right-hand side's 2-norm.
inline constexpr double kTolerance = 1e-6;

struct Solved {
  double setup = 0.0, solve = 0.0;  // processor seconds
  int iterations = 0;
  std::vector<double> x;  // by number of the system
  std::string failed;     // why there is no solution; empty where there is
};

// Of the 2-norm, relative to the right-hand side's; in double precision, whatever the solver says.
double residualOf(const PoissonProblem& problem, const std::vector<double>& x);

Solved solveOurs(const PoissonProblem& problem);

// The system's cells in the order of their coordinates, x slowest, in which peers get them.
std::vector<int> naturalOrder(const sim::PoissonSystem& system);

}  // namespace fluidtex::benchmarks
