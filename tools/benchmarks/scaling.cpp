// How much faster two threads are than one, beside a STREAM triad on the same machine at the same time. By
// the wall's clock, one and two threads in turn.
#include "sim/step/solver.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/measure.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <filesystem>
#include <thread>

namespace fluidtex::benchmarks {
namespace {

// Seconds of a = b + s c on arrays far larger than caches.
double triadSeconds(int threads) {
  constexpr std::size_t kSize = 1u << 24;
  static std::vector<double> a(kSize), b(kSize, 1.0), c(kSize, 2.0);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  const double start = wallSeconds();
  for (int round = 0; round < 10; ++round) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, kSize, kSize / 64), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) a[i] = b[i] + 3.0 * c[i];
    });
    benchmark::ClobberMemory();
  }
  return wallSeconds() - start;
}

double frameSeconds(const sim::State& state, const sim::Options& options, int threads) {
  sim::State copy = state;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  sim::Solver solver(options, std::move(copy));
  const double start = wallSeconds();
  solver.next();
  return wallSeconds() - start;
}

void scaling(benchmark::State& state, int resolution) {
  if (std::thread::hardware_concurrency() < 2) {
    state.SkipWithError("this machine has one core");
    return;
  }
  constexpr int kStart = 8, kRounds = 5;
  const sim::Options options = closedDamBreak(resolution);
  sim::Solver solver(options);
  for (int frame = 1; frame <= kStart; ++frame) solver.next();
  for ([[maybe_unused]] auto _ : state) {
    std::vector<double> ours, triad;
    const double start = wallSeconds();
    for (int round = 0; round < kRounds; ++round) {
      const double triadOne = triadSeconds(1), triadTwo = triadSeconds(2);
      triad.push_back(triadOne / triadTwo);
      const double one = frameSeconds(solver.state(), options, 1),
                   two = frameSeconds(solver.state(), options, 2);
      ours.push_back(one / two);
    }
    state.SetIterationTime(wallSeconds() - start);
    state.counters["speedup"] = median(ours);
    state.counters["triad_speedup"] = median(triad);
    state.counters["share_of_triad"] = median(ours) / median(triad);
  }
}

}  // namespace

void registerScaling() {
  benchmark::RegisterBenchmark("sim_scaling/64", [](benchmark::State& state) { scaling(state, 64); })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace fluidtex::benchmarks
