// What the benchmarks share: clocks, memory, and figures kept until the end, when peers are compared.
#pragma once

#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <vector>

namespace fluidtex::benchmarks {

// Processor time of this process, all threads together; of a thread that waits, nothing. Seconds.
double processorSeconds();
double wallSeconds();

// The most memory this process has held so far, bytes.
double peakBytes();

double median(std::vector<double> values);

// Keeps `value` (less is better) of a row for printRatios: name is that of a benchmark, a peer's ends in
// /peer:NAME.
void keep(const std::string& name, const std::string& quantity, double value);

// For each row of ours that ran beside peers: how many times as much they need.
void printRatios();

// Runs this very program with these arguments, which answers {"bytes", "UNITs", "seconds"}, and counts
// bytes_per_UNIT. Gives those; nothing where it fails.
std::optional<double> measureMemory(benchmark::State& state, const std::string& arguments,
                                    const std::string& unit);

// Called with the arguments that measureMemory was given; false when they are none of their own. See
// memory.cpp and surface.cpp.
bool answerSelf(int argc, char** argv);
bool answerSurface(int argc, char** argv);

// A row that runs once and measures its own time (State::SetIterationTime).
template <class Run>
void addRow(const std::string& name, const Run& run, benchmark::TimeUnit unit = benchmark::kMillisecond) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Iterations(1)->UseManualTime()->Unit(unit);
}

// Each file's benchmarks.
void registerCacheFrames();
void registerDamBreak();
void registerPressure();
void registerMemory();
void registerOutput();
void registerScaling();
void registerSurface();
void registerSynthesis();
void registerTransport();
void registerWindowSearch();

}  // namespace fluidtex::benchmarks
