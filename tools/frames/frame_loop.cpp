#include "tools/frames/frame_loop.h"

#include "pipeline/motion.h"
#include "pipeline/start_mesh.h"
#include "pipeline/stopwatch.h"
#include "pipeline/texture_frame.h"
#include "render/frame_name.h"
#include "render/render.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/fingerprint.h"
#include "tools/base/work.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/formats/ply.h"
#include "tools/formats/read_ply.h"
#include "tools/frames/check_drawn_maps.h"
#include "tools/frames/color_between.h"
#include "tools/frames/disk_plan.h"
#include "tools/frames/earlier_exports.h"
#include "tools/frames/exemplar_fit.h"
#include "tools/frames/export_frame.h"
#include "tools/frames/image_notes.h"
#include "tools/frames/memory_plan.h"
#include "tools/frames/onto_mesh.h"
#include "tools/frames/picture_notes.h"
#include "tools/frames/progress.h"
#include "tools/frames/start_note.h"
#include "tools/frames/time_plan.h"
#include "tools/frames/visible_solids.h"
#include "tools/frames/write_video.h"
#include "tools/run_folder/cache_folder.h"
#include "tools/run_folder/earlier_frames.h"
#include "tools/run_folder/earlier_run.h"
#include "tools/run_folder/input_files.h"
#include "tools/run_folder/journal.h"
#include "tools/run_folder/report.h"
#include "tools/run_folder/state.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Between two looks for files that are waited for.
constexpr std::chrono::milliseconds kPoll{250};

// A finished frame: the motion, the surface that came out, what it took.
struct FrameResult {
  sim::Frame motion;
  pipeline::TexturedFrame textured;
  StageSeconds seconds;
};

const char* nameOf(pipeline::Stage stage) {
  switch (stage) {
    case pipeline::Stage::prepare:
      return "prepare";
    case pipeline::Stage::transport:
      return "transport";
    case pipeline::Stage::synthesize:
      return "synthesize";
  }
  return "";
}

class FrameLoop {
 public:
  FrameLoop(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop)
      : m_scene(scene),
        m_options(options),
        m_stop(stop),
        m_last(options.lastFrame > 0 ? options.lastFrame : scene.frames),
        m_inputs(contentsOf(scene)),
        m_detail(options.render ? detailOf(scene.texture) : std::nullopt),
        m_texturing(pipeline::makeTexturing(scene, kept())),
        m_solids(scene.sim),
        m_reportFile(options.out) {
    if (options.render) checkDrawnMaps(scene.render, m_texturing.synthesizer.exemplar);
    m_surface.spacing = scene.texture.spacing;
    m_report.scene = Json::parse(scene.resolved);
    m_report.seed = scene.seed;
    m_report.threads = options.threads;
    m_report.inputs = m_inputs;
    m_exports = {options.formats, options.joints, appearanceOf(m_report.scene, exemplarColor())};
  }

  void run() {
    if (!m_options.resume || !continueFromState()) {
      nowAt(kOnMotion);
      m_motion = pipeline::makeMotion(m_scene);
      refuseOwnPictures();
      clearEarlierRun(m_options.out, m_scene.name);
    }
    writePictures(m_options.out, exemplarColor(), m_scene.texture.exemplar.betweenFile);
    exportEarlierFrames(m_options.out, m_options.firstFrame,
                        std::min(pipeline::stateOf(*m_motion).frame, m_last), m_exports, exemplarColor(),
                        m_stop);
    tellWarnings();
    for (const std::string& note : imageNotes(colorPictures(m_scene.texture.exemplar))) warn(note);
    tellDisk();
    if (m_scene.texture.spacing <= 0.0 && m_surface.empty()) tellFit(m_scene.texture.points);
    tellNote(waysNote(m_scene.texture.orientation));
    const int first = pipeline::stateOf(*m_motion).frame + 1;
    spdlog::info("{}: frames {} to {}, {} threads", m_scene.name, first, m_last, m_options.threads);
    Progress progress(first, m_last, m_options.quiet);
    m_progress = &progress;
    try {
      for (int frame = first; frame <= m_last; ++frame) oneFrame();
    } catch (...) {
      tellSoFar();
      throw;
    }
    m_progress = nullptr;
    finish();
  }

 private:
  // Pictures of a sequence are read as they are shown, and those of an earlier run go before that.
  void refuseOwnPictures() const {
    for (const fs::path& file : m_scene.texture.exemplar.animation.files)
      for (const char* folder : {kMovingExemplar, "frames"})
        if (fs::weakly_canonical(file.parent_path()) == fs::weakly_canonical(m_options.out / folder))
          throw UsageError(fmt::format("{}: lies where this run writes; give another --out", file.string()));
  }

  void warn(const std::string& warning) const {
    spdlog::warn("{}", warning);
    if (!m_options.quiet) say("warning: {}\n", warning);
  }

  // Those of the motion that have come up since the last call.
  void tellWarnings() {
    const std::vector<std::string> all = pipeline::warningsOf(*m_motion);
    for (; m_warningsTold < all.size(); ++m_warningsTold) warn(all[m_warningsTold]);
  }

  // What the run is going to take on the disk, where it is known how many points there will be.
  void tellDisk() const {
    const pipeline::LiquidPlan liquid = pipeline::planLiquid(m_scene.sim);
    const double points = plannedPoints(m_scene, liquid).value_or(0.0);
    if (points <= 0.0) return;
    const auto pixelsOf = [](const texture::Image& color) { return double(color.width) * color.height; };
    const bool finer = m_detail && !m_scene.texture.exemplar.betweenFile.empty();
    const int frames = m_last - m_options.firstFrame + 1;
    const double copied = pixelsOf(exemplarColor()) * (scenes::showsMovingPicture(m_scene) ? 1 + frames : 1) +
                          (finer ? pixelsOf(m_detail->color) : 0.0);
    const DiskPlan plan = plannedDisk(m_scene, frames, points, double(liquid.cells), copied, m_options.render,
                                      m_options.formats);
    spdlog::info("disk: {}", textOf(plan));
    if (!m_options.quiet) say("disk: {}\n", textOf(plan));
    if (const std::string note = diskNote(plan, m_options.out); !note.empty()) warn(note);
  }

  // Once it is known how many points there are.
  void tellFit(double points) {
    if (m_fitTold || points <= 0.0) return;
    m_fitTold = true;
    tellNote(fitNote(m_scene.texture, exemplarColor().width, exemplarColor().height, points));
  }

  void tellNote(const std::string& note) const {
    if (note.empty()) return;
    spdlog::info("{}", note);
    if (!m_options.quiet) say("note: {}\n", note);
  }

  texture::CacheFolder kept() const {
    return {cacheFolder(), [this](const std::string& warning) { warn(warning); }};
  }

  void oneFrame() {
    FrameResult result = computeFrame();
    sim::Frame& motion = result.motion;
    StageSeconds& seconds = result.seconds;
    const pipeline::TexturedFrame& textured = result.textured;
    m_surface = std::move(result.textured.surface);
    tellFit(double(m_surface.positions.size()));
    Json record = frameRecord(motion, m_surface, textured.singularities, textured.synthesis);
    const std::size_t substeps = motion.substeps.size();
    motion.substeps.clear();  // their grids would stay in memory while the picture is drawn
    if (motion.index >= m_options.firstFrame) writeResults(motion.index, motion.time, seconds);
    nowAt(kOnFrameFiles, motion.index);
    {
      pipeline::Stopwatch watch(seconds.write);
      recordCost(record, seconds);
      saveState(pipeline::stateOf(*m_motion), m_surface, toJson(reportOf(record)), m_options.out / "state");
    }
    recordCost(record, seconds);
    addToJournal(m_options.out, {lineOfFrame(record)});
    m_report.frames.push_back(std::move(record));
    m_reportFile.frameDone(m_report);
    const std::string summary = fmt::format(
        "{} substeps, {:.4g} m3, {} points; simulate {:.2f} s, prepare {:.2f}, transport {:.2f}, synthesize "
        "{:.2f}, render {:.2f}, write {:.2f}",
        substeps, motion.stats.volume, m_surface.positions.size(), seconds.simulate, seconds.prepare,
        seconds.transport, seconds.synthesize, seconds.render, seconds.write);
    const sim::FrameStats& stats = motion.stats;
    spdlog::debug(
        "frame {}: {} liquid cells, shortest substep {:.3g} s, {} pressure iterations, residual {:.2g}; "
        "energy {:.5g} to {:.5g} in {} iterations, {:.1f}% renewed",
        motion.index, stats.cells, stats.dtMin, stats.pressureIterations, stats.pressureResidual,
        textured.synthesis.energyStart, textured.synthesis.energyEnd, textured.synthesis.iterations,
        100.0 * textured.synthesis.renewed);
    spdlog::info("frame {}: {}", motion.index, summary);
    m_progress->frameDone(motion.index, summary);
  }

  // Of a program that still runs.
  void waitForFiles() {
    std::filesystem::path told;
    while (const std::optional<fs::path> file = pipeline::awaitedFile(*m_motion)) {
      if (*file != told) {
        spdlog::info("waiting for {}", file->string());
        if (!m_options.quiet) say("waiting for {}\n", file->string());
      }
      told = *file;
      std::this_thread::sleep_for(kPoll);
      if (m_stop) throw Interrupted();
    }
  }

  FrameResult computeFrame() {
    FrameResult result;
    StageSeconds& seconds = result.seconds;
    m_frame = pipeline::stateOf(*m_motion).frame + 1;
    {
      pipeline::Stopwatch watch(seconds.simulate);
      nowAt(kOnMotion, m_frame);
      waitForFiles();
      result.motion = pipeline::nextFrame(*m_motion, reporter("simulate"));
    }
    tellWarnings();
    const int frame = result.motion.index;
    const auto progress = [&](pipeline::Stage stage, double part) {
      nowAt(stage == pipeline::Stage::synthesize ? kOnTexture : kOnSurface, frame);
      reporter(nameOf(stage))(part);
    };
    result.textured = pipeline::textureFrame(m_texturing, m_surface, result.motion, {progress});
    const auto [prepare, transport, synthesize] = result.textured.seconds;
    seconds.prepare = prepare, seconds.transport = transport, seconds.synthesize = synthesize;
    if (const double spacing = result.textured.surface.spacing; spacing != m_surface.spacing)
      spdlog::info("texture: one point every {:.4g} m, {}", spacing,
                   result.textured.foreseenSpacing ? "for the surface that the liquid is going to have"
                                                   : "by the first surface");
    if (frame == 1 && pipeline::beginsWithMesh(m_scene) && !result.textured.surface.empty()) {
      const auto [text, isWarning] = startNote(m_scene.start, result.textured.surface);
      isWarning ? warn(text) : spdlog::info("{}", text);
    }
    return result;
  }

  // The picture and the surfaces of the frame that m_surface is of, and lines of the journal that tell of
  // them.
  void writeResults(int frame, double time, StageSeconds& seconds) {
    const std::string name = render::frameName(frame);
    const fs::path surfaceFile = m_options.out / "surface" / (name + ".ply");
    nowAt(kOnFrameFiles, frame);
    {
      pipeline::Stopwatch watch(seconds.write);
      const texture::Joints joints = jointsOf(m_scene.texture, m_surface);
      writeAtomically(surfaceFile, [&](const fs::path& file) { writePly(m_surface, joints, file); });
    }
    if (const std::optional<texture::Image> shown = m_texturing.animation.pictureAt(time)) {
      pipeline::Stopwatch watch(seconds.write);
      writeTextAtomically(m_options.out / exemplarFile(frame), pngOf(*shown));
    }
    if (m_options.render) writePicture(frame, time, surfaceFile, seconds);
    nowAt(kOnFrameFiles, frame);
    pipeline::Stopwatch watch(seconds.write);
    const bool putsOnto = scenes::putsOnto(m_scene);
    if (putsOnto) {
      const texture::TexturedSurface other = onto(frame);
      writeAtomically(m_options.out / "onto" / (name + ".ply"),
                      [&](const fs::path& file) { writePly(other, jointsOf(m_scene.texture, other), file); });
    }
    std::vector<JournalLine> lines;
    for (const std::string& file : resultsOf(frame, frameFilesOf(m_scene, m_options.render)))
      lines.push_back(lineOfFile(file, fingerprintOf(m_options.out / file)));
    addToJournal(m_options.out, lines);
    if (m_exports.formats.size() > 1)
      exportFrame(m_options.out, frame, m_exports, exemplarColor(), m_surface.spacing);
  }

  // Draws the surface as its file has it, with colours of 8 bits, so that fluidtex render gives the same
  // picture.
  void writePicture(int frame, double time, const fs::path& surfaceFile, StageSeconds& seconds) {
    nowAt(kOnPicture, frame);
    render::Picture picture;
    {
      pipeline::Stopwatch watch(seconds.render);
      texture::TexturedSurface surface =
          readPly(surfaceFile, m_surface.exemplarWidth, m_surface.exemplarHeight);
      surface.spacing = m_surface.spacing;
      const texture::Joints joints = jointsOf(m_scene.texture, surface);
      if (m_detail && scenes::showsMovingPicture(m_scene))
        m_detail = detailOfFrame(m_options.out, frame, m_scene.texture.exemplar.toroidal);
      picture = render::render(surface, m_solids.at(time), m_scene.render,
                               viewOfFrame(m_scene, frame, m_detail, surface, joints), reporter("render"));
    }
    pipeline::Stopwatch watch(seconds.write);
    writeAtomically(m_options.out / "frames" / (render::frameName(frame) + ".png"),
                    [&](const fs::path& file) { writePng(picture, file, pictureNotes(m_scene, frame)); });
  }

  const texture::Image& exemplarColor() const { return m_texturing.synthesizer.exemplar.color; }

  // The other mesh of the frame that m_surface is of.
  texture::TexturedSurface onto(int frame) const {
    const int symmetry = m_texturing.orientation.options.symmetry;
    if (!m_scene.onto.files.empty()) return ontoMesh(m_surface, m_scene.onto, frame, symmetry);
    return ontoMesh(m_surface, *pipeline::meshOf(*m_motion, frame), symmetry);
  }

  // The report of one frame.
  Report reportOf(const Json& record) const {
    return {m_report.scene, m_report.seed, m_report.threads, m_report.inputs, {record}};
  }

  // So that run.json has every frame that is done, however the run ends but by a kill. What ends it is worse
  // than what may go wrong here.
  void tellSoFar() {
    try {
      m_reportFile.write(m_report);
    } catch (const std::exception&) {
    }
  }

  void finish() {
    m_reportFile.write(m_report);
    const bool rendered = m_options.render && m_last >= m_options.firstFrame;
    if (rendered) writeVideo(m_scene, m_options.out, m_options.firstFrame, m_last, m_stop, "--resume");
    const fs::path made = rendered ? videoFile(m_scene, m_options.out) : m_options.out / "surface";
    if (!m_options.quiet) say("done: {}\n", made.string());
  }

  // False where there is nothing to go on from.
  bool continueFromState() {
    std::optional<EarlierFrames> earlier = earlierFrames(m_scene, m_options, m_report, m_last);
    if (!earlier) return false;
    m_report.frames = std::move(earlier->records);
    m_motion = pipeline::makeMotion(m_scene, std::move(earlier->solver));
    m_surface = std::move(earlier->surface);
    if (earlier->writeLastAgain) {
      StageSeconds seconds;
      writeResults(pipeline::stateOf(*m_motion).frame, m_report.frames.back().at("time").get<double>(),
                   seconds);
    }
    m_reportFile.write(m_report);
    return true;
  }

  std::function<void(double)> reporter(const char* stage) {
    return [this, stage](double part) {
      if (m_stop) throw Interrupted();
      // None while files of an earlier run are made again.
      if (m_progress == nullptr) return;
      m_progress->update(m_frame, stage, part);
    };
  }

  const scenes::Scene& m_scene;
  const RunOptions& m_options;
  const std::atomic<bool>& m_stop;
  int m_last;
  Json m_inputs;  // known before anything is read of them
  // What pictures show between the points, where it is not their colours.
  std::optional<texture::Detail> m_detail;
  pipeline::Texturing m_texturing;
  std::optional<pipeline::Motion> m_motion;
  std::size_t m_warningsTold = 0;
  bool m_fitTold = false;
  int m_frame = 0;                     // that is being made
  texture::TexturedSurface m_surface;  // of the last frame; its spacing is kept even while it is empty
  VisibleSolids m_solids;
  Report m_report;
  Exports m_exports;
  ReportFile m_reportFile;
  Progress* m_progress = nullptr;
};

}  // namespace

void runScene(const scenes::Scene& scene, const RunOptions& options, const std::atomic<bool>& stop) {
  FrameLoop(scene, options, stop).run();
}

}  // namespace fluidtex::tools
