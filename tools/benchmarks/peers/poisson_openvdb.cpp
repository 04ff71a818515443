// OpenVDB's tools::poisson: conjugate gradients with incomplete Cholesky. It stops on the max norm.
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/poisson.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/PoissonSolver.h>

namespace fluidtex::benchmarks {

Solved solveOpenvdb(const PoissonProblem& problem) {
  openvdb::initialize();
  openvdb::DoubleTree source(0.0);
  openvdb::tree::ValueAccessor<openvdb::DoubleTree> accessor(source);
  const sim::CellNumbering& numbering = problem.system.numbering;
  for (int i = 0; i < numbering.size(); ++i) accessor.setValue(numbering.cell(i), -problem.b[i]);
  // The diagonal starts from 0: 1 for pressure 0 above, nothing at walls.
  const int top = problem.box[2];
  const auto boundary = [top](const openvdb::Coord&, const openvdb::Coord& beyond, double&,
                              double& diagonal) {
    if (beyond[2] == top) diagonal -= 1.0;
  };
  auto state = openvdb::math::pcg::terminationDefaults<double>();
  state.iterations = 5000;
  state.relativeError = kTolerance;
  state.absoluteError = 0.0;
  constexpr bool kSevenPoints = true;  // "staggered": cells beside each other are linked
  openvdb::util::NullInterrupter interrupter;
  using Matrix = openvdb::tools::poisson::LaplacianMatrix;
  using Preconditioner = openvdb::math::pcg::IncompleteCholeskyPreconditioner<Matrix>;
  Solved solved;
  const double start = processorSeconds();
  const auto x = openvdb::tools::poisson::solveWithBoundaryConditionsAndPreconditioner<Preconditioner>(
      source, boundary, state, interrupter, kSevenPoints);
  solved.solve = processorSeconds() - start;  // with the set-up
  solved.iterations = state.iterations;
  if (!state.success) solved.failed = "OpenVDB's solver did not converge";
  solved.x.resize(problem.b.size());
  for (int i = 0; i < numbering.size(); ++i) solved.x[i] = x->getValue(numbering.cell(i));
  return solved;
}

}  // namespace fluidtex::benchmarks
