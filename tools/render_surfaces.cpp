// fluidtex render SCENE --from DIR: pictures and video of surfaces that are there already, by the program's
// own path tracer or by Blender's.
#include "render/bump.h"
#include "render/frame_name.h"
#include "render/render.h"
#include "texture/shown/vector_maps.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/stop_signal.h"
#include "tools/base/work.h"
#include "tools/common_options.h"
#include "tools/draw_by_cycles.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/formats/ply.h"
#include "tools/formats/read_ply.h"
#include "tools/frames/color_between.h"
#include "tools/frames/picture_notes.h"
#include "tools/frames/progress.h"
#include "tools/frames/visible_solids.h"
#include "tools/frames/write_video.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/earlier_run.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// With which an interrupted call goes on.
constexpr const char* kOnward = "--missing";

// The run's own exemplar; the scene says only in what picture of it colours are looked up.
texture::Options optionsOf(const FinishedRun& run, texture::Options options) {
  options.exemplar.file = run.exemplar;
  options.exemplar.halvings = 0;
  options.exemplar.toroidal = run.toroidal;
  return options;
}

struct RenderOptions {
  CommonOptions common;
  fs::path from;
  bool missing = false;  // only pictures that are not there yet
  bool part = false;     // beside other processes, which draw other frames into the same folder
  bool byCycles = false;
  CyclesOptions cycles;
  std::vector<std::string> maps;  // KIND=IMAGE, of cycles
  fs::path blend;                 // nothing is drawn, but saved for Blender
};

// Frames to be drawn, all of which have a surface.
struct Frames {
  int first = 1, last = 0;
  std::vector<int> drawn;  // those that are
};

fs::path surfaceOf(const fs::path& from, int frame) {
  return from / "surface" / (render::frameName(frame) + ".ply");
}

fs::path pictureOf(const fs::path& out, int frame) {
  return out / "frames" / (render::frameName(frame) + ".png");
}

Frames framesOf(const RenderOptions& wanted, const scenes::Scene& scene, const fs::path& out) {
  Frames frames;
  parseFrames(wanted.common.frames, scene, frames.first, frames.last);
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    if (!fs::exists(surfaceOf(wanted.from, frame)))
      throw UsageError(fmt::format("{}: is not there; give --frames of which there are surfaces",
                                   surfaceOf(wanted.from, frame).string()));
    if (!wanted.missing || !fs::exists(pictureOf(out, frame))) frames.drawn.push_back(frame);
  }
  return frames;
}

// Of KIND=IMAGE, by what they say.
std::map<std::string, fs::path> mapsOf(const std::vector<std::string>& texts) {
  std::map<std::string, fs::path> maps;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string kind = text.substr(0, equals);
    if (equals == text.npos || equals + 1 == text.size() ||
        std::find(std::begin(kMapsOfCycles), std::end(kMapsOfCycles), kind) == std::end(kMapsOfCycles))
      throw UsageError(fmt::format("--map {}: is no map; write KIND=IMAGE, where KIND is one of {}", text,
                                   fmt::join(kMapsOfCycles, ", ")));
    if (!maps.emplace(kind, text.substr(equals + 1)).second)
      throw UsageError(fmt::format("--map {}: there is a map of {} already", text, kind));
    if (!fs::exists(maps[kind])) throw UsageError(fmt::format("--map {}: there is no such picture", text));
  }
  return maps;
}

// Draws pictures one after the other, and tells of them.
class Drawing {
 public:
  Drawing(const RenderOptions& wanted, const scenes::Scene& scene, const Frames& frames, const fs::path& out,
          const std::atomic<bool>& stop)
      : m_wanted(wanted),
        m_scene(scene),
        m_frames(frames),
        m_out(out),
        m_stop(stop),
        m_progress(frames.last - int(frames.drawn.size()) + 1, frames.last, wanted.common.quiet) {}

  void run() {
    nowAt(kOnPicture);
    if (m_frames.drawn.empty()) return;
    if (m_wanted.byCycles)
      drawInBlender();
    else
      drawHere();
  }

 private:
  void drawHere() {
    const fs::path& from = m_wanted.from;
    VisibleSolids solids(m_scene.sim);
    // Coordinates count in pixels of the exemplar, whose size does not matter to vertices' colours.
    int width = 1, height = 1;
    std::optional<texture::Detail> detail;
    bool moves = false;
    if (m_scene.texture.exemplar.between != texture::Between::points) {
      const FinishedRun run = openRun(from, {});
      width = run.color.width, height = run.color.height;
      if (run.looksUp) detail = detailOf(optionsOf(run, m_scene.texture));
      const bool ofExemplar = m_scene.texture.exemplar.between == texture::Between::exemplar;
      moves = ofExemplar && run.moves;
      if (moves && !run.movesWithTime) detail.reset();  // no picture has the colours of all places
    }
    for (const int frame : m_frames.drawn) {
      nowAt(kOnPicture, frame);
      if (detail && moves) detail = detailOfFrame(from, frame, detail->toroidal);
      texture::TexturedSurface surface = readPly(surfaceOf(from, frame), width, height);
      if (!surface.empty()) checkMaps(from, surfaceOf(from, frame), surface);
      if ((m_scene.render.bump.any() || m_scene.render.displacement.any()) && !surface.empty())
        surface.spacing = spacingOf(from, surface, frame);
      texture::Joints joints;
      if (detail && !surface.empty()) {
        if (lacksGradients(surface)) {
          surface.spacing = spacingOf(from, surface, frame);
          texture::recoverGradients(detail->toroidal, surface);
        }
        joints = texture::findJoints(surface, detail->toroidal);
      }
      take(frame, render::render(surface, solids.at((frame - 1) / m_scene.sim.frameRate), m_scene.render,
                                 viewOfFrame(m_scene, frame, detail, surface, joints),
                                 [&](double part) { show(frame, part); }));
    }
  }

  // The surface has the maps that it is drawn by.
  void checkMaps(const fs::path& from, const fs::path& file, const texture::TexturedSurface& surface) const {
    const render::Options& render = m_scene.render;
    const auto lacks = [&](const char* key, const std::string& map, const char* kind) {
      throw UsageError(
          fmt::format("{0}: has no {1} of {2}, which {3} names; fluidtex apply {4} {1}=IMAGE adds "
                      "it from a grey picture",
                      file.string(), map, kind, key, from.string()));
    };
    if (render.bump.any() && !hasMap(surface, render.bump))
      lacks("render.bump.map", render.bump.map, "one number or of normals");
    if (render.displacement.any() && !surface.maps.contains(render.displacement.map))
      lacks("render.displacement.map", render.displacement.map, "one number");
    if (render.material.glows() && !render.material.heat.empty() &&
        !surface.maps.contains(render.material.heat))
      lacks("render.material.heat", render.material.heat, "one number");
  }

  void drawInBlender() {
    const auto develop = [&](int frame, render::Picture picture) {
      render::develop(picture, m_scene.render.exposure);
      take(frame, picture);
    };
    withTemporaryFolder(m_out / "frames", "cycles", [&](const fs::path& scratch) {
      drawByCycles(m_scene, m_wanted.from, m_frames.drawn, m_wanted.cycles, m_wanted.common.threads, scratch,
                   {develop, [&](int frame, double part) { m_progress.update(frame, "render", part); },
                    [&] { return m_stop.load(); }});
    });
  }

  void show(int frame, double part) {
    if (m_stop) throw Interrupted(kOnward);
    m_progress.update(frame, "render", part);
  }

  void take(int frame, const render::Picture& picture) {
    writeAtomically(pictureOf(m_out, frame),
                    [&](const fs::path& file) { writePng(picture, file, pictureNotes(m_scene, frame)); });
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> seconds = now - m_begun;
    m_begun = now;
    m_progress.frameDone(frame, fmt::format("{:.2f} s", seconds.count()));
  }

  const RenderOptions& m_wanted;
  const scenes::Scene& m_scene;
  const Frames& m_frames;
  const fs::path& m_out;
  const std::atomic<bool>& m_stop;
  Progress m_progress;
  std::chrono::steady_clock::time_point m_begun = std::chrono::steady_clock::now();
};

void renderSurfaces(const RenderOptions& wanted) {
  const CommonOptions& options = wanted.common;
  const fs::path& from = wanted.from;
  if (!fs::is_directory(from))
    throw UsageError(
        fmt::format("--from {}: there is no such folder; give that of a run of fluidtex run", from.string()));
  const scenes::Scene scene = loadScene(options);
  const fs::path out = options.out.empty() ? fs::path("out") / scene.name : options.out;
  const Frames frames = framesOf(wanted, scene, out);
  if (!wanted.blend.empty()) {
    saveForBlender(scene, from, wanted.cycles, wanted.blend);
    if (!options.quiet) say("done: {}\n", wanted.blend.string());
    return;
  }
  const OutFolder folder(out, wanted.part ? Holding::together : Holding::alone);
  if (!wanted.part) removeLeftovers(out);
  const std::atomic<bool>& stop = stopOnSignals(kOnward);
  const tbb::global_control threads(
      tbb::global_control::max_allowed_parallelism,
      std::size_t(options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency()));
  Drawing(wanted, scene, frames, out, stop).run();
  if (wanted.part) return;
  writeVideo(scene, out, frames.first, frames.last, stop, kOnward);
  if (!options.quiet) say("done: {}\n", videoFile(scene, out).string());
  // Surfaces alone, without a run's figures, have no page.
  if (options.noReport || !fs::exists(from / "run.json")) return;
  writeReport({from, out});
  if (!options.quiet) say("report: {}\n", (out / "report.html").string());
}

std::vector<Option> cyclesOptions(RenderOptions& options) {
  const std::string with = "--cycles";
  return {
      {with, &options.byCycles, "",
       "Draw by Blender's path tracer, Cycles, which looks the exemplar up at every place"},
      {"--shutter",
       &options.cycles.shutter,
       "FRAMES",
       "With --cycles: how many frames the shutter is open, for motion blur (default: camera.shutter of the "
       "scene)",
       {.least = 0.0, .most = 1000.0, .with = with}},
      {"--shader",
       &options.cycles.shader,
       "NAME",
       "With --cycles: coat, as the program's own pictures have it (default), or principled, Blender's own",
       {.words = {"coat", "principled"}, .with = with}},
      {"--map",
       &options.maps,
       "KIND=IMAGE",
       "With --cycles: a picture over the exemplar, of any size, for color, roughness, normal, bump, "
       "displacement or alpha; may be repeated",
       {.with = with}},
      {"--height",
       &options.cycles.height,
       "M",
       "With --map of bump or displacement: of white above black, metres (default: 0.01)",
       {.with = with}},
      {"--blend",
       &options.blend,
       "FILE",
       "With --cycles: save it all as a file of Blender's, NAME.blend, and draw nothing",
       {.ending = ".blend", .with = with}},
  };
}

}  // namespace

Command renderCommand() {
  const auto options = std::make_shared<RenderOptions>();
  Command command{"render", "Render the surfaces of a finished run anew"};
  command.options = sceneOptions(options->common);
  append(
      command.options,
      {{"--from", &options->from, "DIR", "Folder of the run whose surfaces are rendered", {.required = true}},
       {"--missing", &options->missing, "", "Draw only pictures that are not there yet"},
       {"--part", &options->part, "",
        "Draw beside other processes that draw other --frames into the same folder; pictures only"},
       {"--no-report", &options->common.noReport, "", "Write no report.html"}});
  append(command.options, cyclesOptions(*options));
  command.footer =
      "Examples:\n"
      "  fluidtex render scenes/dam_break.toml --from out/dam_break --out out/closer --set camera.fov=15\n"
      "  fluidtex render scenes/dam_break.toml --from out/dam_break --out out/cycles --cycles --shutter 0.5";
  command.run = [options] {
    options->cycles.maps = mapsOf(options->maps);
    renderSurfaces(*options);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
