// Memory of a running dam break, and of two balls in a space without an end. Each figure comes from a program
// of its own, since what a program has once held the system goes on counting.
#include "sim/step/solver.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/measure.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace fluidtex::benchmarks {
namespace {

constexpr const char *kAskDamBreak = "--measure-memory", *kAskBalls = "--measure-empty-space";

void memory(benchmark::State& state, const std::string& row, const std::string& ask, int size, int frames) {
  for ([[maybe_unused]] auto _ : state) {
    const auto bytes =
        measureMemory(state, ask + " " + std::to_string(size) + " " + std::to_string(frames), "cell");
    if (!bytes) return;
    state.counters["frames"] = frames;
    keep(row, "bytes / cell", *bytes);
  }
}

// Weightless, 24 cells wide, so many cells apart along each axis; they fly side by side.
sim::Options twoBalls(int apart) {
  sim::Options options;
  options.sides.fill(sim::Side::unbounded);
  options.gravity = sim::Vec3d(0.0);
  options.viscosity = 0.0;
  options.cfl = kCfl;
  const double h = options.voxelSize();
  const sim::Vec3d velocity(1.0, 0.5, -0.5);
  for (const double way : {0.0, h * apart})
    options.liquid.push_back({{sim::Sphere{sim::Vec3d(0.5 + way), 12.0 * h}}, velocity});
  return options;
}

}  // namespace

bool answerSelf(int argc, char** argv) {
  if (argc != 4) return false;
  const bool balls = std::strcmp(argv[1], kAskBalls) == 0;
  if (!balls && std::strcmp(argv[1], kAskDamBreak) != 0) return false;
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const int size = std::atoi(argv[2]);
  const sim::Options options = balls ? twoBalls(size) : closedDamBreak(size);
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
  const auto add = [](const std::string& row, const char* ask, int size, int frames) {
    benchmark::RegisterBenchmark(row.c_str(),
                                 [=](benchmark::State& state) { memory(state, row, ask, size, frames); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  struct Size {
    int resolution, frames;
  };
  for (const Size size : {Size{64, 24}, Size{128, 6}, Size{256, 6}}) {
    const std::string row = "sim_memory/" + std::to_string(size.resolution);
    add(row, kAskDamBreak, size.resolution, size.frames);
  }
  for (const int apart : {64, 1024, 16384})
    add("sim_empty_space/" + std::to_string(apart), kAskBalls, apart, 24);
}

}  // namespace fluidtex::benchmarks
