// Synthesis: what an exemplar costs before its first window is matched, without and with what an earlier run
// has kept; a first frame; and later frames of a texture that is drawn out evenly, neighbourhoods included.
// Processor time of one thread, but for the preparation, which is wall time on all.
#include "sim/motion/motion.h"
#include "texture/frames/synthesize.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/orient.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/textured_samples.h"
#include "transport/carry.h"

#include <tbb/global_control.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace fluidtex::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr int kLevels = 3;
constexpr double kFrame = 1.0 / 24.0;  // s
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

// A level sheet that is drawn out evenly, as in scenes/flows/stretch.toml.
class StretchedSheet {
 public:
  explicit StretchedSheet(int points) : m_motion(sim::makeMotion(liquid(points), flow())) {
    m_spacing = texture::spacingForPoints(*sim::nextFrame(m_motion).surfacePhi, points);
    m_motion = sim::makeMotion(liquid(points), flow());
  }

  // The next frame's synthesis, alone, is what is timed: seconds.
  double next(texture::Synthesizer& made, texture::SynthesisStats& stats) {
    const sim::Frame frame = sim::nextFrame(m_motion);
    const texture::Seeds seeds{transport::moved(m_last.positions, frame), m_last.positions, m_last.triangles,
                               m_last.scale};
    texture::Surface surface =
        texture::prepareSurface(*frame.surfacePhi, m_spacing, seeds, m_last.empty() ? kLevels : 1, {});
    const texture::Carried carried = transport::carry(m_last, frame, surface.levels[0]);
    texture::orient(surface, carried);
    const double from = processorSeconds();
    m_last = texture::synthesize(made, std::move(surface), carried, frame.index, kFrame, stats);
    const double seconds = processorSeconds() - from;
    m_last.velocity = transport::velocityAt(m_last.positions, frame);
    m_last.contact = transport::contactAt(m_last.positions, frame);
    return seconds;
  }
  std::size_t vertices() const { return m_last.positions.size(); }

 private:
  static sim::Options liquid(int points) {
    sim::Options options;
    options.size = {1.5, 1.5, 0.4};
    // As many cells as points along a side.
    options.resolution = std::max(48, int(std::sqrt(0.5 * points)));
    sim::LiquidBody sheet;
    sheet.shape = {sim::Box{{-0.5, -0.5, 0.16}, {2.0, 2.0, 0.24}}};
    options.liquid.push_back(sheet);
    return options;
  }
  static sim::MotionOptions flow() {
    sim::MotionOptions motion;
    motion.flow = sim::MotionKind::stretch;
    return motion;
  }

  sim::Motion m_motion;
  double m_spacing = 0.0;
  texture::TexturedSurface m_last;
};

void laterFrames(benchmark::State& state, int points, int size) {
  texture::Synthesizer made = synthesizer(size, {});
  made.options.firstIterations = {1, 1, 1};  // the first frame is not what is timed
  StretchedSheet sheet(points);
  texture::SynthesisStats stats;
  for (int frame = 0; frame < kFramesBefore; ++frame) sheet.next(made, stats);
  for ([[maybe_unused]] auto _ : state) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    double seconds = 0.0, renewed = 0.0;
    for (int frame = 0; frame < kFramesTimed; ++frame) {
      seconds += sheet.next(made, stats) / kFramesTimed;
      renewed += stats.renewed / kFramesTimed;
    }
    count(state, seconds, double(sheet.vertices()));
    state.counters["renewed"] = renewed;
  }
}

}  // namespace

void registerSynthesis() {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  for (const int size : {256, 1024})
    add("synthesis_prepare/" + std::to_string(size), [=](benchmark::State& s) { prepare(s, size); });
  const auto addFrames = [&](const std::string& name, int points, int size) {
    add("synthesis_first" + name, [=](benchmark::State& s) { firstFrame(s, points, size); });
    add("synthesis_later" + name, [=](benchmark::State& s) { laterFrames(s, points, size); });
  };
  for (const int points : {20000, 200000, 1000000}) addFrames("/" + std::to_string(points), points, 256);
  for (const int size : {64, 128, 512, 1024})
    addFrames("/20000/exemplar:" + std::to_string(size), 20000, size);
}

}  // namespace fluidtex::benchmarks
