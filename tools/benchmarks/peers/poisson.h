// Pressure systems solved by others, each of their conjugate gradients to the tolerance of solveOurs().
#pragma once

#include "tools/benchmarks/poisson_problem.h"

namespace fluidtex::benchmarks {

Solved solveEigen(const PoissonProblem& problem);    // incomplete Cholesky, cells in natural order
Solved solveHypre(const PoissonProblem& problem);    // PFMG, boxes only; `failed` where libhypre is missing
Solved solveOpenvdb(const PoissonProblem& problem);  // incomplete Cholesky, boxes only; stops on the max norm

}  // namespace fluidtex::benchmarks
