// Memory of a running dam break. Each figure comes from a program of its own, since what a program has once
// held the system goes on counting.
#include "sim/solver.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/measure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace fluidtex::benchmarks {
namespace {

constexpr const char* kAsk = "--measure-memory";

void memory(benchmark::State& state, const std::string& row, int resolution, int frames) {
  for ([[maybe_unused]] auto _ : state) {
    const auto bytes = measureMemory(
        state, std::string(kAsk) + " " + std::to_string(resolution) + " " + std::to_string(frames), "cell");
    if (!bytes) return;
    state.counters["frames"] = frames;
    keep(row, "bytes / cell", *bytes);
  }
}

}  // namespace

bool answerSelf(int argc, char** argv) {
  if (argc != 4 || std::strcmp(argv[1], kAsk) != 0) return false;
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const sim::Options options = closedDamBreak(std::atoi(argv[2]));
  const double before = peakBytes(), start = processorSeconds();
  std::int64_t cells = 0;
  sim::Solver solver(options);
  // A frame is let go of before the next one is made.
  for (int frame = 1; frame <= std::atoi(argv[3]); ++frame)
    cells = std::max(cells, solver.next().stats.cells);
  std::printf("{\"bytes\": %.0f, \"cells\": %lld, \"seconds\": %g}\n", peakBytes() - before,
              static_cast<long long>(cells), processorSeconds() - start);
  return true;
}

void registerMemory() {
  struct Size {
    int resolution, frames;
  };
  for (const Size size : {Size{64, 24}, Size{128, 6}, Size{256, 6}}) {
    const std::string row = "sim_memory/" + std::to_string(size.resolution);
    benchmark::RegisterBenchmark(
        row.c_str(), [=](benchmark::State& state) { memory(state, row, size.resolution, size.frames); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace fluidtex::benchmarks
