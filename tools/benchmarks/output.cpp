// What a frame costs between its texture and the disk, on one thread: joints are found, and cut for programs
// that know one coordinate a vertex; the surface is written in every format, as a run writes it, beside its
// bytes alone.
#include "pipeline/texture_frame.h"
#include "sim/motion/motion.h"
#include "tests/scratch.h"
#include "texture/joints/cut.h"
#include "texture/joints/joints.h"
#include "tools/base/atomic_file.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/textured_samples.h"
#include "tools/formats/exports.h"
#include "tools/formats/ply.h"

#include <tbb/global_control.h>

#include <fstream>
#include <iterator>

namespace fluidtex::benchmarks {
namespace {

namespace fs = std::filesystem;
using tools::Format;

constexpr int kPoints = 500000, kLevels = 3;
constexpr int kFrames = 3;  // so that some texture has been renewed, and fades
constexpr int kRounds = 5;

// The last frame of a drawn-out sheet, made once; joints are a matter of later frames.
const texture::TexturedSurface& texturedSheet() {
  static const texture::TexturedSurface surface = [] {
    const scenes::Scene scene = stretchedSheet(kPoints);
    pipeline::Texturing texturing = pipeline::makeTexturing(
        scene, texture::makeExemplar(scales(256), true, scene.texture.synthesis, kLevels));
    texturing.synthesizer.options.firstIterations = {1, 1, 1};
    sim::Motion motion = sim::makeMotion(scene.sim, scene.motion);
    texture::TexturedSurface last;
    for (int frame = 1; frame <= kFrames; ++frame)
      last = pipeline::textureFrame(texturing, last, sim::nextFrame(motion)).surface;
    return last;
  }();
  return surface;
}

const texture::Joints& joints() {
  static const texture::Joints found = texture::findJoints(texturedSheet(), true);
  return found;
}

// Times `work` on one thread, kRounds times after a first one that is not counted.
template <class Work>
void measure(benchmark::State& state, const std::string& row, const Work& work) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<double> wall, processor;
  for (int round = 0; round <= kRounds; ++round) {
    const double from = wallSeconds(), used = processorSeconds();
    work();
    if (round == 0) continue;
    wall.push_back(wallSeconds() - from);
    processor.push_back(processorSeconds() - used);
  }
  state.SetIterationTime(median(wall));
  state.counters["wall_s"] = median(wall);
  state.counters["cpu_s"] = median(processor);
  keep(row, "wall s", median(wall));
}

void countSurface(benchmark::State& state) {
  state.counters["points"] = double(texturedSheet().positions.size());
  state.counters["joint_share"] = double(joints().joints.size()) / double(texturedSheet().triangles.size());
}

void find(benchmark::State& state, const std::string& row) {
  const texture::TexturedSurface& surface = texturedSheet();
  for ([[maybe_unused]] auto _ : state)
    measure(state, row, [&] { benchmark::DoNotOptimize(texture::findJoints(surface, true)); });
  countSurface(state);
}

void cut(benchmark::State& state, const std::string& row) {
  const texture::TexturedSurface& surface = texturedSheet();
  std::size_t vertices = 0;
  for ([[maybe_unused]] auto _ : state)
    measure(state, row, [&] { vertices = texture::cutAtJoints(surface, true).surface.positions.size(); });
  countSurface(state);
  state.counters["vertices_over_points"] = double(vertices) / double(surface.positions.size());
}

// Writes the frame's file into the folder as a run does, and gives its name.
fs::path write(Format format, const fs::path& folder) {
  fs::path file = folder / tools::frameFile(format, kFrames);
  if (format == Format::ply) {
    tools::writeAtomically(
        file, [&](const fs::path& temporary) { tools::writePly(texturedSheet(), joints(), temporary); });
    return file;
  }
  tools::Exports exports{{format}, tools::JointsAs::cut, {}};
  exports.appearance.picture = "exemplar.png";
  exports.appearance.toroidal = true;
  tools::writeExports(texturedSheet(), kFrames, (kFrames - 1) / exports.appearance.frameRate, exports,
                      folder);
  return file;
}

void countBytes(benchmark::State& state, double bytes) {
  state.counters["MB"] = 1e-6 * bytes;
  state.counters["MB_per_s"] = 1e-6 * bytes / state.counters["wall_s"].value;
  countSurface(state);
}

void output(benchmark::State& state, const std::string& row, Format format) {
  const Scratch folder;
  joints();
  fs::path file;
  for ([[maybe_unused]] auto _ : state) measure(state, row, [&] { file = write(format, folder.path); });
  countBytes(state, double(fs::file_size(file)));
}

// The same bytes out of memory, to the same disk.
void bytesAlone(benchmark::State& state, const std::string& row, Format format) {
  const Scratch folder;
  const fs::path file = write(format, folder.path);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for ([[maybe_unused]] auto _ : state) measure(state, row, [&] { tools::writeTextAtomically(file, bytes); });
  countBytes(state, double(bytes.size()));
}

}  // namespace

void registerOutput() {
  const std::string size = "/" + std::to_string(kPoints);
  const auto add = [](const std::string& row, const auto& run, auto... more) {
    addRow(row, [=](benchmark::State& state) { run(state, row, more...); });
  };
  add("joints_find" + size, find);
  add("joints_cut" + size, cut);
  for (const Format format : {Format::ply, Format::glb, Format::obj, Format::usda, Format::vtp}) {
    const std::string row = std::string("output_") + tools::filesOf(format).name + size;
    add(row, output, format);
    add(row + "/peer:bytes_alone", bytesAlone, format);
  }
}

}  // namespace fluidtex::benchmarks
