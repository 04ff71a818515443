// fluidtex simulate SCENE --cache DIR: the solver alone; texture goes on from what it leaves.
#include "caches/recorded/recorded_frame.h"
#include "caches/recorded/recording.h"
#include "pipeline/motion.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/stop_signal.h"
#include "tools/base/work.h"
#include "tools/common_options.h"
#include "tools/frames/progress.h"
#include "tools/run_folder/out_folder.h"
#include "tools/run_folder/run_options.h"
#include "tools/run_folder/state.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <memory>
#include <optional>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Files of an earlier simulation. The state goes first, so that a kill in between leaves nothing to go on
// from.
void clearEarlier(const fs::path& folder) {
  removeStates(folder / "state");
  fs::remove(folder / caches::kRecordingFile);
  for (int frame = 1; fs::remove(caches::recordedFrame(folder, frame)); ++frame) {
  }
}

// What the frames of a simulation depend on; the texture may change.
std::string simulated(const scenes::Scene& scene) {
  nlohmann::ordered_json all = nlohmann::ordered_json::parse(scene.resolved);
  for (const char* key : {"quality", "frames", "texture", "camera", "light", "render"}) all.erase(key);
  return all.dump();
}

// Where the folder's frames end, to go on from; nothing where none is done.
std::optional<sim::State> earlierState(const fs::path& folder, const std::string& settings) {
  std::optional<RunState> state = loadState(folder / "state");
  if (!state) return std::nullopt;
  if (state->report != settings)
    throw UsageError(fmt::format(
        "{}: was simulated by other settings; simulate without --resume to start anew", folder.string()));
  for (int frame = 1; frame <= state->solver.frame; ++frame)
    if (!fs::exists(caches::recordedFrame(folder, frame)))
      throw UsageError(fmt::format("{}: is missing; simulate without --resume to start anew",
                                   caches::recordedFrame(folder, frame).string()));
  return std::move(state->solver);
}

void simulate(const scenes::Scene& scene, const CommonOptions& options, const fs::path& folder) {
  int first = 1, last = 0;
  parseFrames(options.frames, scene, first, last);
  if (first > 1)
    throw UsageError(
        fmt::format("--frames {}: a cache holds all frames from 1 on; give 1:{}", options.frames, last));
  const std::atomic<bool>& stop = stopOnSignals();
  const OutFolder lock(folder);
  const std::string settings = simulated(scene);
  nowAt(kOnMotion);
  std::optional<sim::State> state;
  if (options.resume) state = earlierState(folder, settings);
  if (!state) clearEarlier(folder);
  pipeline::Motion motion = pipeline::makeMotion(scene, std::move(state));
  writeTextAtomically(folder / caches::kRecordingFile, caches::recordingText(scene.sim));
  std::size_t told = 0;
  const auto tellWarnings = [&] {
    const std::vector<std::string> all = pipeline::warningsOf(motion);
    for (; told < all.size(); ++told)
      if (!options.quiet) say("warning: {}\n", all[told]);
  };
  tellWarnings();
  Progress progress(pipeline::stateOf(motion).frame + 1, last, options.quiet);
  while (pipeline::stateOf(motion).frame < last) {
    const int next = pipeline::stateOf(motion).frame + 1;
    nowAt(kOnMotion, next);
    const sim::Frame frame = pipeline::nextFrame(motion, [&](double part) {
      if (stop) throw Interrupted();
      progress.update(next, "simulate", part);
    });
    tellWarnings();
    nowAt(kOnFrameFiles, next);
    writeAtomically(caches::recordedFrame(folder, next), [&](const fs::path& file) {
      caches::writeRecordedFrame(frame, scene.sim.voxelSize(), file);
    });
    saveState(pipeline::stateOf(motion), {}, settings, folder / "state");
    progress.frameDone(next,
                       fmt::format("{} substeps, {:.4g} m3", frame.substeps.size(), frame.stats.volume));
  }
  if (!options.quiet) say("done: {}\n", folder.string());
}

}  // namespace

Command simulateCommand() {
  struct Arguments {
    CommonOptions options;
    fs::path cache;
  };
  const auto arguments = std::make_shared<Arguments>();
  Command command{"simulate", "Simulate only, and write a cache that texture goes on from"};
  command.options = simulationOptions(arguments->options);
  append(command.options,
         {{"--cache", &arguments->cache, "DIR", "Folder for the frames", {.required = true}},
          {"--resume", &arguments->options.resume, "",
           "Go on from the last frame that an earlier, unfinished simulation has left in the folder"}});
  command.footer =
      "Example:\n"
      "  fluidtex simulate scenes/dam_break.toml --cache caches/dam_break\n"
      "  fluidtex run scenes/dam_break.toml --set motion.flow=files --set files.path=caches/dam_break";
  command.run = [arguments] {
    const CommonOptions& options = arguments->options;
    const scenes::Scene scene = loadScene(options);
    if (scene.motion.flow == sim::MotionKind::files)
      throw UsageError(options.scene.string() +
                       ": its liquid comes out of files; there is nothing to simulate");
    const int threads = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    atItsLine(options, scene, [&] { simulate(scene, options, arguments->cache); });
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
