// Synthesis: what an exemplar costs before its first window is matched, without and with what an earlier run
// has kept; a first frame; and later frames of a texture that is drawn out evenly, neighbourhoods included.
// Processor time of one thread, but for the preparation, which is wall time on all.
#include "pipeline/texture_frame.h"
#include "sim/motion/motion.h"
#include "texture/frames/synthesize.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/textured_samples.h"

#include <tbb/global_control.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace fluidtex::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr int kLevels = 3;
// A texture as it is laid has nothing to renew: these bring it to where as much is renewed as is stretched.
constexpr int kFramesBefore = 12, kFramesTimed = 6;

texture::Synthesizer synthesizer(int size, const fs::path& cache) {
  const texture::SynthesisOptions options;
  texture::Synthesizer result =
      texture::makeSynthesizer(texture::makeExemplar(scales(size), true, options, kLevels), options, cache);
  texture::prepareTables(result);
  return result;
}

void prepare(benchmark::State& state, int size) {
  const fs::path cache = fs::temp_directory_path() / ("fluidtex-bench-" + std::to_string(::getpid()));
  const texture::Image image = scales(size);
  const texture::SynthesisOptions options;
  const auto seconds = [&] {
    const double from = wallSeconds();
    texture::Synthesizer made = texture::makeSynthesizer(
        texture::makeExemplar(image, true, options, kLevels, {}, cache), options, cache);
    texture::prepareTables(made);
    return wallSeconds() - from;
  };
  for ([[maybe_unused]] auto _ : state) {
    fs::remove_all(cache);
    const double cold = seconds();
    const double cached = median({seconds(), seconds(), seconds()});
    double bytes = 0.0;
    for (const auto& entry : fs::directory_iterator(cache)) bytes += double(entry.file_size());
    fs::remove_all(cache);
    state.SetIterationTime(cold);
    state.counters["cold_s"] = cold;
    state.counters["cached_s"] = cached;
    state.counters["kept_bytes"] = bytes;
  }
}

void count(benchmark::State& state, double seconds, double vertices) {
  state.SetIterationTime(seconds);
  state.counters["per_vertex_ns"] = 1e9 * seconds / vertices;
  state.counters["vertices"] = vertices;
}

void firstFrame(benchmark::State& state, int points, int size) {
  texture::Synthesizer made = synthesizer(size, {});
  const texture::Surface surface = sphere(points, kLevels);
  for ([[maybe_unused]] auto _ : state) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    texture::SynthesisStats stats;
    const double from = processorSeconds();
    const texture::TexturedSurface result = texture::synthesize(made, surface, {}, 1, 0.0, stats);
    count(state, processorSeconds() - from, double(result.positions.size()));
  }
}

void laterFrames(benchmark::State& state, int points, int size) {
  const scenes::Scene scene = stretchedSheet(points);
  pipeline::Texturing texturing = pipeline::makeTexturing(
      scene, texture::makeExemplar(scales(size), true, scene.texture.synthesis, kLevels));
  texture::prepareTables(texturing.synthesizer);
  texturing.synthesizer.options.firstIterations = {1, 1, 1};  // the first frame is not what is timed
  sim::Motion motion = sim::makeMotion(scene.sim, scene.motion);
  texture::TexturedSurface last;
  const auto next = [&] {
    pipeline::TexturedFrame frame =
        pipeline::textureFrame(texturing, last, sim::nextFrame(motion), {{}, processorSeconds});
    last = std::move(frame.surface);
    return frame;
  };
  for (int frame = 0; frame < kFramesBefore; ++frame) next();
  for ([[maybe_unused]] auto _ : state) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    double seconds = 0.0, renewed = 0.0;
    for (int i = 0; i < kFramesTimed; ++i) {
      const pipeline::TexturedFrame frame = next();
      seconds += frame.seconds.synthesize / kFramesTimed;
      renewed += frame.synthesis.renewed / kFramesTimed;
    }
    count(state, seconds, double(last.positions.size()));
    state.counters["renewed"] = renewed;
  }
}

}  // namespace

void registerSynthesis() {
  for (const int size : {256, 1024})
    addRow("synthesis_prepare/" + std::to_string(size), [=](benchmark::State& s) { prepare(s, size); });
  const auto addFrames = [&](const std::string& name, int points, int size) {
    addRow("synthesis_first" + name, [=](benchmark::State& s) { firstFrame(s, points, size); });
    addRow("synthesis_later" + name, [=](benchmark::State& s) { laterFrames(s, points, size); });
  };
  for (const int points : {20000, 200000, 1000000}) addFrames("/" + std::to_string(points), points, 256);
  for (const int size : {64, 128, 512, 1024})
    addFrames("/20000/exemplar:" + std::to_string(size), 20000, size);
}

}  // namespace fluidtex::benchmarks
