// Eigen's conjugate gradients with incomplete Cholesky, cells in natural order.
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/poisson.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace fluidtex::benchmarks {

Solved solveEigen(const PoissonProblem& problem) {
  const sim::PoissonSystem& system = problem.system;
  const std::vector<int> order = naturalOrder(system);
  const int n = int(order.size());
  std::vector<int> place(order.size());
  for (int i = 0; i < n; ++i) place[order[i]] = i;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    const auto& neighbor = system.rows.neighbor[order[i]];
    const auto& link = system.rows.link[order[i]];
    double diagonal = system.anchor[order[i]];
    for (int s = 0; s < sim::kSides; ++s) {
      if (link[s] <= 0.0f) continue;
      diagonal += double(link[s]);
      entries.emplace_back(i, place[neighbor[s]], -double(link[s]));
    }
    entries.emplace_back(i, i, diagonal);
    b[i] = problem.b[order[i]];
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());

  using Preconditioner = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, Preconditioner> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(5000);
  Solved solved;
  const double start = processorSeconds();
  solver.compute(matrix);
  const double middle = processorSeconds();
  const Eigen::VectorXd x = solver.solve(b);
  solved.setup = middle - start;
  solved.solve = processorSeconds() - middle;
  solved.iterations = int(solver.iterations());
  if (solver.info() != Eigen::Success) solved.failed = "Eigen's solver did not converge";
  solved.x.resize(order.size());
  for (int i = 0; i < n; ++i) solved.x[order[i]] = x[i];
  return solved;
}

}  // namespace fluidtex::benchmarks
