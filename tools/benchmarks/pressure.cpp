// Pressure systems, ours against other solvers. Seconds are set-up and solve together, without filling the
// matrix.
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/poisson.h"
#include "tools/benchmarks/poisson_problem.h"

#include <tbb/global_control.h>

#include <functional>
#include <memory>

namespace fluidtex::benchmarks {
namespace {

using Make = std::function<PoissonProblem()>;
using Solve = Solved (*)(const PoissonProblem&);

// When the wave has hit the far wall.
constexpr int kDamBreakFrames = 12;

// Made when it is first asked for, and kept for the peers.
const PoissonProblem& problemOf(const std::string& name, const Make& make) {
  static std::string kept;
  static std::unique_ptr<PoissonProblem> problem;
  if (kept != name) {
    problem.reset();
    problem = std::make_unique<PoissonProblem>(make());
    kept = name;
  }
  return *problem;
}

void run(benchmark::State& state, const std::string& problemName, const std::string& row, const Make& make,
         Solve solve) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const PoissonProblem& problem = problemOf(problemName, make);
  std::vector<double> seconds;
  Solved last;
  for ([[maybe_unused]] auto _ : state) {
    last = solve(problem);
    if (!last.failed.empty()) {
      state.SkipWithError(last.failed.c_str());
      return;
    }
    seconds.push_back(last.setup + last.solve);
    state.SetIterationTime(seconds.back());
  }
  const double residual = residualOf(problem, last.x);
  state.counters["median_s"] = median(seconds);
  state.counters["setup_s"] = last.setup;
  state.counters["iterations"] = last.iterations;
  state.counters["unknowns"] = double(problem.b.size());
  state.counters["residual"] = residual;
  state.counters["per_cell_ns"] = 1e9 * median(seconds) / double(problem.b.size());
  keep(row, "s", median(seconds));
}

void add(const std::string& name, const Make& make, const std::string& peer, Solve solve, int times) {
  const std::string row = peer.empty() ? name : name + "/peer:" + peer;
  benchmark::RegisterBenchmark(row.c_str(),
                               [=](benchmark::State& state) { run(state, name, row, make, solve); })
      ->Iterations(times)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void registerPressure() {
  const Make box = [] { return boxProblem(128); };
  add("sim_pressure_box", box, "", solveOurs, 5);
  add("sim_pressure_box", box, "hypre_pfmg", solveHypre, 5);
  add("sim_pressure_box", box, "eigen_iccg", solveEigen, 1);
  add("sim_pressure_box", box, "openvdb_iccg", solveOpenvdb, 1);
  for (const int n : {64, 128, 256})
    add(
        "sim_pressure_box_sizes/" + std::to_string(n), [n] { return boxProblem(n); }, "", solveOurs, 1);
  const Make dam = [] { return damBreakProblem(128, kDamBreakFrames); };
  add("sim_pressure_dam_break", dam, "", solveOurs, 5);
  add("sim_pressure_dam_break", dam, "eigen_iccg", solveEigen, 1);
}

}  // namespace fluidtex::benchmarks
