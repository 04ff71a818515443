// hypre's conjugate gradients with its multigrid for boxes, PFMG.
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/poisson.h"

#ifdef FLUIDTEX_HYPRE

#include <HYPRE_struct_ls.h>

namespace fluidtex::benchmarks {

Solved solveHypre(const PoissonProblem& problem) {
  int already = 0;
  MPI_Initialized(&already);
  if (already == 0) {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  const sim::PoissonSystem& system = problem.system;
  const std::vector<int> order = naturalOrder(system);
  // hypre runs through a box with the first index fastest: z, y, x.
  int low[3] = {0, 0, 0};
  int high[3] = {problem.box[2] - 1, problem.box[1] - 1, problem.box[0] - 1};
  HYPRE_StructGrid grid;
  HYPRE_StructGridCreate(MPI_COMM_WORLD, 3, &grid);
  HYPRE_StructGridSetExtents(grid, low, high);
  HYPRE_StructGridAssemble(grid);

  // Symmetric: the middle, and the lower neighbours.
  HYPRE_StructStencil stencil;
  HYPRE_StructStencilCreate(3, 4, &stencil);
  int offsets[4][3] = {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (int e = 0; e < 4; ++e) HYPRE_StructStencilSetElement(stencil, e, offsets[e]);
  HYPRE_StructMatrix matrix;
  HYPRE_StructMatrixCreate(MPI_COMM_WORLD, grid, stencil, &matrix);
  HYPRE_StructMatrixSetSymmetric(matrix, 1);
  HYPRE_StructMatrixInitialize(matrix);
  std::vector<double> entries(4 * order.size()), b(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& link = system.rows.link[order[i]];
    double diagonal = system.anchor[order[i]];
    for (const float l : link) diagonal += double(l);
    entries[4 * i] = diagonal;
    entries[4 * i + 1] = -double(link[4]);
    entries[4 * i + 2] = -double(link[2]);
    entries[4 * i + 3] = -double(link[0]);
    b[i] = problem.b[order[i]];
  }
  int which[4] = {0, 1, 2, 3};
  HYPRE_StructMatrixSetBoxValues(matrix, low, high, 4, which, entries.data());
  HYPRE_StructMatrixAssemble(matrix);
  HYPRE_StructVector right, left;
  for (HYPRE_StructVector* vector : {&right, &left}) {
    HYPRE_StructVectorCreate(MPI_COMM_WORLD, grid, vector);
    HYPRE_StructVectorInitialize(*vector);
  }
  HYPRE_StructVectorSetBoxValues(right, low, high, b.data());
  HYPRE_StructVectorSetConstantValues(left, 0.0);
  HYPRE_StructVectorAssemble(right);
  HYPRE_StructVectorAssemble(left);

  HYPRE_StructSolver multigrid, solver;
  HYPRE_StructPFMGCreate(MPI_COMM_WORLD, &multigrid);
  HYPRE_StructPFMGSetMaxIter(multigrid, 1);
  HYPRE_StructPFMGSetTol(multigrid, 0.0);
  HYPRE_StructPFMGSetZeroGuess(multigrid);
  HYPRE_StructPFMGSetRelaxType(multigrid, 2);  // red-black Gauss-Seidel, symmetric
  HYPRE_StructPFMGSetRAPType(multigrid, 1);
  HYPRE_StructPFMGSetNumPreRelax(multigrid, 1);
  HYPRE_StructPFMGSetNumPostRelax(multigrid, 1);
  HYPRE_StructPFMGSetSkipRelax(multigrid, 1);
  HYPRE_StructPCGCreate(MPI_COMM_WORLD, &solver);
  HYPRE_StructPCGSetMaxIter(solver, 500);
  HYPRE_StructPCGSetTol(solver, kTolerance);
  HYPRE_StructPCGSetTwoNorm(solver, 1);
  HYPRE_StructPCGSetPrecond(solver, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid);

  Solved solved;
  const double start = processorSeconds();
  HYPRE_StructPCGSetup(solver, matrix, right, left);
  const double middle = processorSeconds();
  HYPRE_StructPCGSolve(solver, matrix, right, left);
  solved.setup = middle - start;
  solved.solve = processorSeconds() - middle;
  HYPRE_StructPCGGetNumIterations(solver, &solved.iterations);
  std::vector<double> x(order.size());
  HYPRE_StructVectorGetBoxValues(left, low, high, x.data());
  solved.x.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) solved.x[order[i]] = x[i];

  HYPRE_StructPCGDestroy(solver);
  HYPRE_StructPFMGDestroy(multigrid);
  HYPRE_StructVectorDestroy(left);
  HYPRE_StructVectorDestroy(right);
  HYPRE_StructMatrixDestroy(matrix);
  HYPRE_StructStencilDestroy(stencil);
  HYPRE_StructGridDestroy(grid);
  return solved;
}

}  // namespace fluidtex::benchmarks

#else

namespace fluidtex::benchmarks {

Solved solveHypre(const PoissonProblem&) {
  Solved solved;
  solved.failed =
      "hypre was not there when the benchmarks were built: apt-get install libhypre-dev, and build anew";
  return solved;
}

}  // namespace fluidtex::benchmarks

#endif
