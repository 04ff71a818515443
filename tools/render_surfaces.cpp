// fluidtex render SCENE --from DIR: pictures and video of surfaces that are there already.
#include "render/bump.h"
#include "render/frame_name.h"
#include "render/render.h"
#include "texture/shown/vector_maps.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/work.h"
#include "tools/common_options.h"
#include "tools/frames/color_between.h"
#include "tools/frames/picture_notes.h"
#include "tools/frames/visible_solids.h"
#include "tools/output/ply.h"
#include "tools/output/read_ply.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// The run's own exemplar; the scene says only in what picture of it colours are looked up.
texture::Options optionsOf(const FinishedRun& run, texture::Options options) {
  options.exemplar.file = run.exemplar;
  options.exemplar.toroidal = run.toroidal;
  return options;
}

struct RenderOptions {
  CommonOptions common;
  fs::path from;
  bool missing = false;  // only pictures that are not there yet
  bool part = false;     // beside other processes, which draw other frames into the same folder
};

fs::path pictureOf(const fs::path& out, int frame) {
  return out / "frames" / (render::frameName(frame) + ".png");
}

void renderSurfaces(const RenderOptions& wanted) {
  const CommonOptions& options = wanted.common;
  const fs::path& from = wanted.from;
  if (!fs::is_directory(from))
    throw UsageError(
        fmt::format("--from {}: there is no such folder; give that of a run of fluidtex run", from.string()));
  const scenes::Scene scene = loadScene(options);
  int first = 1, last = 0;
  parseFrames(options.frames, scene, first, last);
  if (last == 0) last = scene.frames;
  const auto surfaceOf = [&](int frame) { return from / "surface" / (render::frameName(frame) + ".ply"); };
  for (int frame = first; frame <= last; ++frame)
    if (!fs::exists(surfaceOf(frame)))
      throw UsageError(fmt::format("{}: is not there; give --frames of which there are surfaces",
                                   surfaceOf(frame).string()));
  const fs::path out = options.out.empty() ? fs::path("out") / scene.name : options.out;
  const OutFolder folder(out, wanted.part ? Holding::together : Holding::alone);
  const tbb::global_control threads(
      tbb::global_control::max_allowed_parallelism,
      std::size_t(options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency()));
  VisibleSolids solids(scene.sim);
  // Coordinates count in pixels of the exemplar, whose size does not matter to vertices' colours.
  int width = 1, height = 1;
  std::optional<texture::Detail> detail;
  if (scene.texture.exemplar.between != texture::Between::points) {
    const FinishedRun run = openRun(from, {});
    width = run.color.width, height = run.color.height;
    if (run.looksUp) detail = detailOf(optionsOf(run, scene.texture));
  }
  for (int frame = first; frame <= last; ++frame) {
    if (wanted.missing && fs::exists(pictureOf(out, frame))) continue;
    texture::TexturedSurface surface = readPly(surfaceOf(frame), width, height);
    if (scene.render.bump.any() && !surface.empty()) {
      if (!hasMap(surface, scene.render.bump))
        throw UsageError(
            fmt::format("{0}: has no {1} of one number or of normals, which render.bump.map names; "
                        "fluidtex apply {2} {1}=IMAGE adds it from a grey picture",
                        surfaceOf(frame).string(), scene.render.bump.map, from.string()));
      surface.spacing = spacingOf(from, surface, frame);
    }
    texture::Joints joints;
    if (detail && !surface.empty()) {
      if (lacksGradients(surface)) {
        surface.spacing = spacingOf(from, surface, frame);
        texture::recoverGradients(detail->toroidal, surface);
      }
      joints = texture::findJoints(surface, detail->toroidal);
    }
    const double progress = scene.frames > 1 ? double(frame - 1) / (scene.frames - 1) : 0.0;
    nowAt(kOnPicture, frame);
    const render::Picture picture =
        render::render(surface, solids.at((frame - 1) / scene.sim.frameRate), scene.render,
                       {scene.sim.size, progress, frame, colorBetween(detail, surface, joints),
                        detail && detail->seeThrough, scene.domainOrigin});
    writeAtomically(pictureOf(out, frame),
                    [&](const fs::path& file) { writePng(picture, file, pictureNotes(scene, frame)); });
    if (!options.quiet) say("frame {}\n", frame);
  }
  if (wanted.part) return;
  const fs::path video = out / (scene.name + ".mp4");
  writeAtomically(video, [&](const fs::path& file) {
    render::writeVideo(out / "frames", first, last, scene.sim.frameRate, file);
  });
  if (!options.quiet) say("done: {}\n", video.string());
  // Surfaces alone, without a run's figures, have no page.
  if (options.noReport || !fs::exists(from / "run.json")) return;
  writeReport({from, out});
  if (!options.quiet) say("report: {}\n", (out / "report.html").string());
}

}  // namespace

void addRender(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("render", "Render the surfaces of a finished run anew");
  auto options = std::make_shared<RenderOptions>();
  addSceneOptions(*command, options->common);
  command->add_option("--from", options->from, "Folder of the run whose surfaces are rendered")
      ->required()
      ->type_name("DIR");
  command->add_flag("--missing", options->missing, "Draw only pictures that are not there yet");
  command->add_flag(
      "--part", options->part,
      "Draw beside other processes that draw other --frames into the same folder; pictures only");
  command->add_flag("--no-report", options->common.noReport, "Write no report.html");
  command->footer(
      "Example:\n  fluidtex render scenes/dam_break.toml --from out/dam_break --out out/closer --set "
      "camera.fov=15");
  command->callback([options, &exitCode] { exitCode = guarded([&] { renderSurfaces(*options); }); });
}

}  // namespace fluidtex::tools
