#include "tools/run_folder/finished_run.h"

#include "render/frame_name.h"
#include "scenes/numbered_files.h"
#include "texture/exemplar/read_image.h"
#include "tools/base/errors.h"
#include "tools/base/work.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/run_folder/journal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Whether it has what the commands look for, in the types that they take.
bool isReport(const Json& report) {
  const auto texture = "/scene/texture"_json_pointer;
  if (!report.is_object() || !report.contains(texture) || !report[texture].is_object()) return false;
  const Json& own = report[texture];
  const auto fits = [](const Json& object, const char* key, auto is) {
    return !object.contains(key) || (object[key].*is)();
  };
  if (!fits(own, "exemplar", &Json::is_string) || !fits(own, "toroidal", &Json::is_boolean)) return false;
  const auto frames = report.find("frames");
  return frames != report.end() && frames->is_array() &&
         std::all_of(frames->begin(), frames->end(), [&](const Json& record) {
           return record.is_object() && fits(record, "frame", &Json::is_number_integer);
         });
}

}  // namespace

Json readReport(const fs::path& out) {
  const fs::path file = out / "run.json";
  std::ifstream in(file, std::ios::binary);
  if (!in) throw UsageError(file.string() + ": cannot be read; give the folder of a run of fluidtex run");
  Json report = Json::parse(std::string{std::istreambuf_iterator<char>(in), {}}, nullptr, false);
  if (!isReport(report))
    throw UsageError(file.string() + ": is no report of a run; give the folder of a run of fluidtex run");
  Json& frames = report["frames"];
  const int last = !frames.empty() && frames.back().is_object() ? frames.back().value("frame", 0) : 0;
  for (auto& [frame, record] : readJournal(out).frames)
    if (frame > last) frames.push_back(std::move(record));
  return report;
}

std::vector<int> framesIn(const fs::path& folder, std::string_view extension) {
  std::vector<int> frames;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == extension)
      if (const auto frame = render::frameNumber(entry.path().stem().string())) frames.push_back(*frame);
  std::sort(frames.begin(), frames.end());
  return frames;
}

fs::path FinishedRun::surfaceOf(int frame) const {
  return out / "surface" / (render::frameName(frame) + ".ply");
}

const Json* recordOf(const FinishedRun& run, int frame) {
  for (const Json& record : run.report["frames"])
    if (record.value("frame", -1) == frame) return &record;
  return nullptr;
}

Json* recordOf(FinishedRun& run, int frame) {
  return const_cast<Json*>(recordOf(std::as_const(run), frame));
}

double spacingOf(const FinishedRun& run, const texture::TexturedSurface& surface, int frame) {
  const Json* record = recordOf(run, frame);
  if (record != nullptr && record->contains("spacing") && (*record)["spacing"].is_number())
    return (*record)["spacing"].get<double>();
  double area = 0.0;
  for (const texture::Vec3I& t : surface.triangles) {
    const texture::Vec3f &a = surface.positions[t[0]], &b = surface.positions[t[1]],
                         &c = surface.positions[t[2]];
    area += 0.5 * (b - a).cross(c - a).length();
  }
  return std::sqrt(area / double(surface.positions.size()));
}

double spacingOf(const fs::path& out, const texture::TexturedSurface& surface, int frame) {
  const Json none{{"frames", Json::array()}};
  return spacingOf(FinishedRun{.out = out,
                               .report = fs::exists(out / "run.json") ? readReport(out) : none,
                               .exemplar = {},
                               .color = {},
                               .frames = {}},
                   surface, frame);
}

const fs::path& existing(const fs::path& out) {
  if (!fs::is_directory(out))
    throw UsageError((out / "run.json").string() +
                     ": cannot be read; give the folder of a run of fluidtex run");
  return out;
}

bool looksUp(std::string_view method, std::string_view laterFrames) {
  return method == "coordinates" && (laterFrames == "synthesize" || laterFrames == "alone");
}

FinishedRun openRun(const fs::path& out, const fs::path& exemplar) {
  FinishedRun run{.out = out, .report = readReport(out), .exemplar = exemplar, .color = {}, .frames = {}};
  const Json& texture = run.report["scene"]["texture"];
  if (exemplar.empty()) run.exemplar = fs::path(texture.value("exemplar", ""));
  run.exemplar = scenes::firstOf(run.exemplar);
  // A mesh's picture was halved until it fitted the points.
  const bool halved =
      texture.value("/start/file"_json_pointer, Json()).is_string() && fs::exists(out / kExemplarFile);
  if (exemplar.empty() && halved) run.exemplar = out / kExemplarFile;
  // A folder that was moved to another machine has its own.
  if (exemplar.empty() && !fs::exists(run.exemplar) && fs::exists(out / kExemplarFile))
    run.exemplar = out / kExemplarFile;
  if (!fs::exists(run.exemplar))
    throw UsageError(fmt::format("{}: the exemplar of the run is not there; give --exemplar IMAGE",
                                 run.exemplar.string()));
  run.toroidal = texture.value("toroidal", false);
  const std::string later = texture.value("later_frames", "synthesize");
  run.looksUp = looksUp(texture.value("method", ""), later);
  run.isProjected = texture.value("method", "") != "none" && (later == "birth" || later == "dual_rest");
  run.moves = run.looksUp && scenes::isPattern(texture.value("exemplar", ""));
  run.movesWithTime = run.moves && texture.value("/animation/by"_json_pointer, "time") == "time";
  run.color = texture::readImage(run.exemplar);
  if (halved && !exemplar.empty()) {
    const texture::Image used = texture::readImage(out / kExemplarFile);
    if (used.width != run.color.width || used.height != run.color.height)
      throw UsageError(
          fmt::format("{}: has {} x {} pixels, and the run took its picture halved to {} x {}; give {}",
                      exemplar.string(), run.color.width, run.color.height, used.width, used.height,
                      (out / kExemplarFile).string()));
  }
  nowAt(kOnRun);
  run.frames = framesIn(out / "surface", ".ply");
  if (run.frames.empty())
    throw UsageError((out / "surface").string() +
                     ": holds no surface; give the folder of a run of fluidtex run");
  return run;
}

}  // namespace fluidtex::tools
