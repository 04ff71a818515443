// fluidtex run SCENE: simulate, texture, render and write, frame by frame, in memory.
#include "tools/run.h"

#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/stop_signal.h"
#include "tools/base/work.h"
#include "tools/common_options.h"
#include "tools/frames/frame_loop.h"
#include "tools/frames/memory_plan.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/out_folder.h"

#include <fmt/core.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <memory>
#include <new>
#include <stdexcept>

namespace fluidtex::tools {
namespace {

// Lines are added to what is there: a run that starts anew empties the file when it clears the earlier run.
void logTo(const std::filesystem::path& file, bool verbose) {
  auto logger = std::make_shared<spdlog::logger>(
      "fluidtex", std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()));
  logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  logger->flush_on(spdlog::level::info);
  // A disk that is full is told of by what it keeps from being written.
  logger->set_error_handler([](const std::string&) {});
  spdlog::set_default_logger(logger);
}

// What is known of it; the run's own memory is free again.
std::string neededBy(const scenes::Scene& scene, const RunOptions& run) {
  try {
    const pipeline::LiquidPlan liquid = pipeline::planLiquid(scene.sim);
    const double bytes = plannedMemory(scene, liquid, plannedPoints(scene, liquid), run.formats, run.joints);
    return fmt::format(" (the scene needs about {:.2g} GB in all)", bytes / 1e9);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

void runInto(const std::filesystem::path& out, const scenes::Scene& scene, const CommonOptions& options) {
  RunOptions run;
  run.out = out;
  parseFrames(options.frames, scene, run.firstFrame, run.lastFrame);
  run.resume = options.resume;
  run.render = !options.noRender;
  run.formats = parseFormats(options.formats);
  run.joints = jointsAs(options);
  run.quiet = options.quiet;
  run.threads = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(run.threads));
  const OutFolder folder(run.out);
  logTo(run.out / "log.txt", options.verbose);
  nowAt(kOnExemplar);
  try {
    atItsLine(options, scene, [&] { runScene(scene, run, stopOnSignals()); });
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(outOfMemory() + neededBy(scene, run));
  }
  if (options.noReport) return;
  writeReport({run.out, run.out});
  if (!options.quiet) say("report: {}\n", (run.out / "report.html").string());
}

namespace {

// A command that does as `run`; its footer is missing.
Command runningCommand(const std::string& name, const std::string& text) {
  const auto options = std::make_shared<CommonOptions>();
  Command command{name, text};
  command.options = sceneOptions(*options);
  append(command.options,
         {{"--resume", &options->resume, "",
           "Go on from the last frame that an earlier, unfinished run has left in the folder"},
          {"--follow", &options->follow, "",
           "Wait for files of another program that still runs; --set frames=N says how many there will be"},
          {"--no-render", &options->noRender, "", "Write surfaces only, no pictures and no video"},
          {"--no-report", &options->noReport, "", "Write no report.html"}});
  append(command.options, formatOptions(*options));
  command.run = [options] {
    const scenes::Scene scene = loadScene(*options);
    runInto(options->out.empty() ? std::filesystem::path("out") / scene.name : options->out, scene, *options);
    return kDone;
  };
  return command;
}

}  // namespace

Command runCommand() {
  Command command = runningCommand("run", "Simulate, texture, render and write, frame by frame");
  command.footer =
      "Example:\n"
      "  fluidtex run scenes/dam_break.toml --quality preview --exemplar bark.jpg --set texture.points=20000 "
      "--out out/bark";
  return command;
}

Command textureCommand() {
  Command command = runningCommand("texture", "Texture and render the liquid of another program's cache");
  command.footer =
      "Examples:\n"
      "  fluidtex texture cache_fluid --exemplar lava.jpg\n"
      "  fluidtex texture 'water_####.vdb' --exemplar bark.jpg --set files.up=y --out out/water";
  return command;
}

}  // namespace fluidtex::tools
