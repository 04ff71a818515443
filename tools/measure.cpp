// fluidtex measure OUT: how good the texture of a finished run is, in figures.
#include "tools/measure.h"

#include "render/frame_name.h"
#include "render/motion_image.h"
#include "render/render.h"
#include "texture/exemplar/srgb.h"
#include "texture/measure/change.h"
#include "texture/measure/contrast.h"
#include "texture/measure/measure.h"
#include "texture/measure/new_surface.h"
#include "texture/measure/pieces.h"
#include "texture/measure/tiles.h"
#include "texture/measure/wear.h"
#include "texture/shown/maps.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/common_options.h"
#include "tools/formats/ply.h"
#include "tools/formats/read_ply.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Keys of a frame, and heads of the columns that show them.
constexpr std::pair<const char*, const char*> kColumns[] = {{"likeness", "likeness"},
                                                            {"sharpness", "sharp"},
                                                            {"spectrum", "spectrum"},
                                                            {"coverage", "coverage"},
                                                            {"contrast", "contrast"},
                                                            {"repeats", "repeats"},
                                                            {"shape", "shape"},
                                                            {"seams", "seams"},
                                                            {"joints", "joints"},
                                                            {"chips", "chips"},
                                                            {"pop", "pop"},
                                                            {"change", "change"},
                                                            {"renewed", "renewed"},
                                                            {"change_along_flow", "along flow"},
                                                            {"coherence", "coherence"},
                                                            {"warp", "warp"},
                                                            {"worn", "worn"},
                                                            {"least_change", "least"}};

// A side of a scene's pictures, pixels.
constexpr std::int64_t kLargestPicture = 16384;

// Camera and size of the run's pictures; nothing where the report does not tell them.
std::optional<render::Options> viewOf(const Json& scene) {
  const auto vector = [](const Json& values, render::Vec3d& to) {
    if (!values.is_array() || values.size() != 3) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (!values[std::size_t(axis)].is_number()) return false;
      to[axis] = values[std::size_t(axis)].get<double>();
    }
    return true;
  };
  const Json camera = scene.value("camera", Json::object()), render = scene.value("render", Json::object());
  if (!camera.is_object() || !render.is_object()) return std::nullopt;
  const Json size = render.value("size", Json::array());
  if (!size.is_array() || size.size() != 2 || !size[0].is_number_integer() || !size[1].is_number_integer() ||
      !camera.contains("fov") || !camera["fov"].is_number())
    return std::nullopt;
  render::Options view;
  const auto width = size[0].get<std::int64_t>(), height = size[1].get<std::int64_t>();
  if (std::min(width, height) < 2 || std::max(width, height) > kLargestPicture) return std::nullopt;
  view.width = int(width);
  view.height = int(height);
  view.camera.fov = camera["fov"].get<double>();
  if (camera.contains("turn") && camera["turn"].is_number()) view.camera.turn = camera["turn"].get<double>();
  if (!vector(camera.value("from", Json()), view.camera.from) ||
      !vector(camera.value("at", Json()), view.camera.at))
    return std::nullopt;
  return view;
}

// As the colours are, without light.
render::Picture unlit(const render::MotionImage& image) {
  render::Picture picture{image.width, image.height, {}};
  for (const render::Vec3f& color : image.color)
    for (int c = 0; c < 3; ++c) picture.rgb.push_back(texture::decodeSrgb(color[c]));
  return picture;
}

class Measurer {
 public:
  explicit Measurer(const MeasureWishes& wishes)
      : m_wishes(wishes),
        m_folder(existing(wishes.out)),
        m_run(openRun(wishes.out, wishes.exemplar)),
        m_view(viewOf(m_run.report["scene"])) {}

  void run() {
    const std::vector<int>& frames = m_run.frames;
    texture::LikenessJudge judge(m_run.color);
    const double deviation = texture::deviationOfLuminance(m_run.color);
    const texture::Image contrast = texture::contrastOf(m_run.color);
    if (!m_wishes.quiet) printHead();
    Json rows = Json::array();
    texture::TexturedSurface before;
    render::MotionImage seenBefore;
    if (!m_wishes.motion.empty()) {
      if (!m_view)
        throw UsageError(fmt::format("--motion: {} tells no camera and no size of the pictures",
                                     (m_wishes.out / "run.json").string()));
      fs::create_directories(m_wishes.motion);
    }
    for (std::size_t n = 0; n < frames.size(); ++n) {
      const int frame = frames[n];
      texture::TexturedSurface surface = readSurface(frame);
      Json row;
      row["frame"] = frame;
      row["vertices"] = surface.positions.size();
      const bool follows = n > 0 && frames[n - 1] == frame - 1;
      if (n % std::size_t(m_wishes.every) == 0 || n + 1 == frames.size()) {
        addLikeness(row, judge(surface, n == 0 || n + 1 == frames.size()));
        if (!m_run.isProjected) {
          if (const auto found = texture::measureContrast(surface, contrast)) row["contrast"] = *found;
          addPieces(row, texture::measurePieces(surface, m_run.color, m_run.toroidal));
        }
      }
      render::MotionImage seen = m_view ? seenIn(frame, surface) : render::MotionImage();
      if (follows) {
        addChange(row, texture::measureChange(before, surface, m_run.color, m_run.toroidal));
        addFlowWear(row, texture::measureFlowWear(surface, deviation));
        if (m_view) addWarp(row, render::warpError(seenBefore, seen, 2.0 * surface.spacing));
      }
      if (!m_wishes.quiet && row.size() > 2) printRow(fmt::format("{}", frame), row);
      rows.push_back(std::move(row));
      before = std::move(surface);
      seenBefore = std::move(seen);
    }
    const Json mean = meanOf(rows);
    if (!m_wishes.quiet) printRow("mean", mean);
    fillReport(rows);
    if (m_wishes.json.empty()) return;
    const Json all = {{"exemplar", m_run.exemplar.generic_string()},
                      {"spacing", m_spacing},
                      {"every", m_wishes.every},
                      {"frames", rows},
                      {"mean", mean}};
    writeTextAtomically(m_wishes.json, all.dump(1) + "\n");
  }

 private:
  // What the run's camera sees; also written where that is wished.
  render::MotionImage seenIn(int frame, const texture::TexturedSurface& surface) const {
    const Json& scene = m_run.report["scene"];
    const auto frames = scene.find("frames");
    const int last = frames != scene.end() && frames->is_number_integer() ? frames->get<int>() : 1;
    const auto progress = [&](int at) {
      return last > 1 ? std::clamp(double(at - 1) / (last - 1), 0.0, 1.0) : 0.0;
    };
    render::MotionImage seen =
        render::motionImage(surface, texture::seenColors(surface), *m_view, progress(frame),
                            progress(frame - 1), texture::kNewSurface);
    if (m_wishes.motion.empty()) return seen;
    const fs::path name = m_wishes.motion / render::frameName(frame);
    writeAtomically(name.string() + ".png",
                    [&](const fs::path& file) { render::writePng(unlit(seen), file); });
    writeAtomically(name.string() + ".flo", [&](const fs::path& file) { render::writeFlo(seen, file); });
    return seen;
  }

  texture::TexturedSurface readSurface(int frame) {
    texture::TexturedSurface surface = readPly(m_run.surfaceOf(frame), m_run.color.width, m_run.color.height);
    if (surface.empty()) return surface;
    surface.spacing = spacingOf(m_run, surface, frame);
    // What moves in the exemplar is no change of the texture: it is measured in one picture.
    if (m_run.moves) texture::lookUpColor(m_run.color, m_run.toroidal, surface);
    if (m_spacing == 0.0) m_spacing = surface.spacing;
    return surface;
  }

  static void addLikeness(Json& row, const std::optional<texture::Likeness>& found) {
    if (!found) return;
    row["likeness"] = found->likeness;
    row["sharpness"] = found->sharpness;
    row["spectrum"] = found->spectrum;
    row["coverage"] = found->coverage;
    if (found->repeats) row["repeats"] = *found->repeats;
    row["tile"] = found->tile;
    row["tiles"] = found->tiles;
  }
  static void addPieces(Json& row, const std::optional<texture::Pieces>& found) {
    if (!found) return;
    row["shape"] = found->shape;
    row["shape_median"] = found->shapeMedian;
    row["shape_worst"] = found->shapeWorst;
    row["seams"] = found->seams;
    row["joints"] = found->joints;
    row["chips"] = found->chips;
    row["pieces"] = found->pieces;
  }
  void addChange(Json& row, const std::optional<texture::Change>& found) const {
    if (!found) return;
    row["pop"] = found->pop;
    if (!m_run.isProjected) {
      row["change"] = found->change;
      row["renewed"] = found->renewed;
    }
    row["change_along_flow"] = found->alongFlow;
    row["coherence"] = found->ratio;
  }
  static void addFlowWear(Json& row, const std::optional<texture::FlowWear>& found) {
    if (!found) return;
    row["worn"] = found->worn;
    row["least_change"] = found->change;
  }

  static void addWarp(Json& row, const std::optional<render::WarpError>& found) {
    if (!found) return;
    row["warp"] = found->error;
    row["warp_share"] = found->share;
  }

  // Of every key over the frames that have it.
  static Json meanOf(const Json& rows) {
    Json mean;
    for (const auto& [key, head] : kColumns) {
      double sum = 0.0;
      int count = 0;
      for (const Json& row : rows)
        if (row.contains(key)) {
          sum += row[key].get<double>();
          ++count;
        }
      if (count > 0) mean[key] = sum / count;
    }
    return mean;
  }

  static void printHead() {
    print("{:>6}", "frame");
    for (const auto& [key, head] : kColumns) print(" {:>10}", head);
    print("\n");
  }
  static void printRow(const std::string& name, const Json& row) {
    print("{:>6}", name);
    for (const auto& [key, head] : kColumns)
      print(" {:>10}", row.contains(key) ? fmt::format("{:.4f}", row[key].get<double>()) : "");
    print("\n");
  }

  void fillReport(const Json& rows) {
    for (const Json& row : rows) {
      Json* record = recordOf(m_run, row["frame"].get<int>());
      if (record == nullptr) continue;
      for (const char* key : {"likeness", "sharpness", "pop", "change_along_flow"})
        if (row.contains(key)) (*record)[key] = row[key];
    }
    writeTextAtomically(m_wishes.out / "run.json", m_run.report.dump(2) + "\n");
    if (fs::exists(m_wishes.out / "report.html")) writeReport({m_wishes.out, m_wishes.out});
  }

  const MeasureWishes& m_wishes;
  const OutFolder m_folder;
  FinishedRun m_run;
  std::optional<render::Options> m_view;
  double m_spacing = 0.0;  // of the first surface
};

}  // namespace

void measureRun(const MeasureWishes& wishes) {
  Measurer(wishes).run();
}

Command measureCommand() {
  const auto wishes = std::make_shared<MeasureWishes>();
  Command command{"measure", "Measure the texture of a finished run"};
  command.options = {
      {"out", &wishes->out, "OUT", "Folder of the run", {.required = true}},
      exemplarOfRun(wishes->exemplar),
      {"--json", &wishes->json, "FILE", "Write all figures to this file"},
      {"--every",
       &wishes->every,
       "K",
       "Likeness, contrast and pieces on every K-th frame and the last (default: 8); repeats on the first "
       "and "
       "the last; change on all",
       {.least = 1, .most = 9999}},
      {"--motion", &wishes->motion, "DIR",
       "Write there what the camera sees, unlit, and the motion of each pixel to the frame before (FLO)"},
      {"--quiet", &wishes->quiet, "", "No table, only files"},
  };
  command.footer = "Example:\n  fluidtex measure out/dam_break --json measures.json";
  command.run = [wishes] {
    measureRun(*wishes);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
