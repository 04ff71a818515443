#include "tools/run_folder/report.h"

#include "texture/mesh/mesh_stats.h"
#include "tools/base/atomic_file.h"

#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>

namespace fluidtex::tools {
namespace {

std::int64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

// The value where `known`, else null: what is not known is never invented.
template <typename T>
Json orNull(bool known, T value) {
  return known ? Json(value) : Json(nullptr);
}

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

// One [x, y, z, turns] each, metres.
Json pointsOf(const std::vector<texture::Singularity>& singularities) {
  Json points = Json::array();
  for (const texture::Singularity& s : singularities)
    points.push_back({s.position.x(), s.position.y(), s.position.z(), s.turns});
  return points;
}

}  // namespace

Json frameRecord(const sim::Frame& frame, const texture::TexturedSurface& surface,
                 const std::optional<std::vector<texture::Singularity>>& singularities,
                 const texture::SynthesisStats& synthesis) {
  const texture::MeshStats mesh = texture::meshStats(surface.positions, surface.triangles, surface.normals);
  const bool textured = !surface.empty(), optimised = textured && synthesis.iterations > 0;
  Json record;
  record["frame"] = frame.index;
  record["time"] = frame.time;
  record["substeps"] = frame.substeps.size();
  record["dt_min"] = orNull(!frame.substeps.empty(), frame.stats.dtMin);
  record["cells"] = frame.stats.cells;
  record["volume"] = frame.stats.volume;
  record["deficit"] = frame.stats.deficit;
  if (frame.stats.explained) record["explained"] = *frame.stats.explained;
  record["vertices"] = surface.positions.size();
  record["triangles"] = surface.triangles.size();
  record["components"] = mesh.components;
  record["spacing"] = orNull(textured, surface.spacing);
  record["edge_mean"] = orNull(textured, mesh.edgeMean);
  record["edge_cv"] = orNull(textured, mesh.edgeCv);
  record["folded"] = mesh.folded;
  record["spikes"] = mesh.spikes;
  record["singularities"] = singularities ? Json(singularities->size()) : Json(nullptr);
  record["singular_points"] = singularities ? pointsOf(*singularities) : Json(nullptr);
  record["energy_start"] = orNull(optimised, synthesis.energyStart);
  record["energy_end"] = orNull(optimised, synthesis.energyEnd);
  record["iterations"] = orNull(textured, synthesis.iterations);
  record["renewed"] = orNull(textured, synthesis.renewed);
  record["likeness"] = nullptr;
  record["sharpness"] = nullptr;
  record["change_along_flow"] = nullptr;
  return record;
}

void recordCost(Json& record, const StageSeconds& seconds) {
  record["seconds"] = {{"simulate", seconds.simulate},   {"prepare", seconds.prepare},
                       {"transport", seconds.transport}, {"synthesize", seconds.synthesize},
                       {"render", seconds.render},       {"write", seconds.write}};
  record["peak_rss"] = peakMemory();
}

std::string toJson(const Report& report) {
  Json json;
  json["version"] = FLUIDTEX_VERSION;
  json["scene"] = report.scene;
  json["seed"] = report.seed;
  json["threads"] = report.threads;
  json["inputs"] = report.inputs;
  json["frames"] = report.frames;
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Report parseReport(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    return {json.at("scene"), json.at("seed").get<std::uint64_t>(), json.at("threads").get<int>(),
            json.value("inputs", Json::object()), json.at("frames").get<std::vector<Json>>()};
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("run.json of the state is damaged: ") + error.what());
  }
}

std::string sceneDifference(const Json& before, const Json& now, const Json& inputs) {
  const auto flat = [](Json scene) {
    if (scene.value("/camera/turn"_json_pointer, 0.0) == 0.0) scene.erase("frames");
    return scene.flatten();
  };
  Json old = flat(before), current = flat(now);
  for (const auto& [dotted, content] : inputs.items()) {
    const std::string key = replaced("." + dotted, '.', '/');
    if (!old.value(key, Json()).is_string() || !current.value(key, Json()).is_string()) continue;
    old.erase(key);
    current.erase(key);
  }
  const auto shown = [](const Json& json, const std::string& key) {
    return json.contains(key) ? json.at(key).dump() : std::string("not there");
  };
  for (const Json* side : {&old, &current})
    for (const auto& [key, value] : side->items()) {
      const std::string a = shown(old, key), b = shown(current, key);
      if (a == b) continue;
      return replaced(key.substr(1), '/', '.') + " was " + a + " and is " + b;
    }
  return {};
}

void ReportFile::frameDone(const Report& report) {
  if (report.frames.size() >= m_written + std::max<std::size_t>(1, m_written / 8)) write(report);
}

void ReportFile::write(const Report& report) {
  writeTextAtomically(m_file, toJson(report));
  m_written = report.frames.size();
}

}  // namespace fluidtex::tools
