// The benchmarks: Google Benchmark's program, with ratios to the peers at the end. See
// docs/results/benchmarks.md.
#include "tools/base/keep_memory.h"
#include "tools/benchmarks/measure.h"

int main(int argc, char** argv) {
  using namespace fluidtex::benchmarks;
  fluidtex::tools::keepMemory();  // as the program does
  if (answerSelf(argc, argv) || answerSurface(argc, argv)) return 0;
  registerPressure();
  registerCacheFrames();
  registerDamBreak();
  registerMemory();
  registerScaling();
  registerSurface();
  registerSynthesis();
  registerTransport();
  registerOutput();
  registerWindowSearch();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  printRatios();
  return 0;
}
