// A closed dam break, frame by frame, against Blender's liquid solver.
#include "sim/step/solver.h"
#include "tools/benchmarks/closed_dam_break.h"
#include "tools/benchmarks/measure.h"

#include <openvdb/io/File.h>
#include <tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace fluidtex::benchmarks {
namespace {

namespace fs = std::filesystem;

// Frames that are told the volume of.
constexpr std::array<int, 3> kVolumeFrames{12, 24, 48};

struct Tally {
  double seconds = 0.0;
  int frames = 0, steps = 0;

  void tell(benchmark::State& state, const std::string& name) const {
    state.SetIterationTime(seconds / frames);
    state.counters["s_per_frame"] = seconds / frames;
    state.counters["s_per_substep"] = seconds / steps;
    state.counters["substeps_per_frame"] = double(steps) / frames;
    state.counters["frames"] = frames + 1;
    keep(name, "s / frame", seconds / frames);
    keep(name, "s / substep", seconds / steps);
  }
};

void tellVolume(benchmark::State& state, int frame, double share) {
  if (std::find(kVolumeFrames.begin(), kVolumeFrames.end(), frame) == kVolumeFrames.end()) return;
  state.counters["volume_" + std::to_string(frame)] = share;
}

void ours(benchmark::State& state, const std::string& name, int resolution, int frames) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  for ([[maybe_unused]] auto _ : state) {
    sim::Solver solver(closedDamBreak(resolution));
    const double first = solver.next().stats.volume;
    Tally tally;
    for (int frame = 2; frame <= frames; ++frame) {
      const double start = processorSeconds();
      const sim::Frame made = solver.next();
      tally.seconds += processorSeconds() - start;
      ++tally.frames;
      tally.steps += int(made.substeps.size());
      tellVolume(state, frame, made.stats.volume / first);
    }
    tally.tell(state, name);
  }
}

// Cubic cells of liquid in one file of mantaflow's cache: its phi is dense, in cells, and 0 where nothing is
// stored.
double mantaflowVolume(const fs::path& path) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open(false);
  const auto phi = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("phi"));
  phi->tree().voxelizeActiveTiles();
  double volume = 0.0;
  for (auto it = phi->cbeginValueOn(); it; ++it) volume += std::clamp(0.5 - double(*it), 0.0, 1.0);
  return volume;
}

void mantaflow(benchmark::State& state, const std::string& name, int resolution, int frames) {
  if (std::system("command -v blender > /dev/null") != 0) {
    state.SkipWithError("blender is not installed: apt-get install blender");
    return;
  }
  for ([[maybe_unused]] auto _ : state) {
    std::string folder = (fs::temp_directory_path() / "fluidtex_mantaflow_XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
      state.SkipWithError("no folder for mantaflow's cache could be made");
      return;
    }
    const std::string output = folder + "/output.txt";
    const std::string command = "blender -b --factory-startup -t 1 -P \"" FLUIDTEX_BENCHMARKS
                                "/mantaflow_dam_break.py\" -- " +
                                std::to_string(resolution) + " " + std::to_string(frames) + " " +
                                std::to_string(kCfl) + " " + folder + " > " + output + " 2>&1";
    const bool ran = std::system(command.c_str()) == 0;
    Tally tally;
    std::ifstream lines(output);
    for (std::string line; std::getline(lines, line);) {
      const auto told = nlohmann::json::parse(line, nullptr, false);
      if (!told.is_object() || told.value("frame", 0) < 2) continue;
      // The solver's steps alone: without what Blender does around them, its cache among it.
      tally.seconds += told.at("step_seconds").get<double>();
      tally.steps += told.at("steps").get<int>();
      ++tally.frames;
    }
    if (!ran || tally.steps == 0) {
      state.SkipWithError("blender ran, but its liquid solver did not");
    } else {
      tally.tell(state, name);
      const auto cache = [&](int frame) {
        std::array<char, 32> file{};
        std::snprintf(file.data(), file.size(), "/data/fluid_data_%04d.vdb", frame);
        return mantaflowVolume(folder + file.data());
      };
      const double first = cache(1);
      for (const int frame : kVolumeFrames) {
        if (frame <= frames) tellVolume(state, frame, cache(frame) / first);
      }
    }
    fs::remove_all(folder);
  }
}

}  // namespace

void registerDamBreak() {
  struct Size {
    int resolution, frames;
  };
  for (const Size size : {Size{64, 48}, Size{128, 12}}) {
    const std::string name = "sim_dam_break/" + std::to_string(size.resolution);
    const auto add = [&](const std::string& row, auto run) {
      benchmark::RegisterBenchmark(
          row.c_str(), [=](benchmark::State& state) { run(state, row, size.resolution, size.frames); })
          ->Iterations(1)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    };
    add(name, ours);
    add(name + "/peer:mantaflow", mantaflow);
  }
}

}  // namespace fluidtex::benchmarks
