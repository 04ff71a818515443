#include "tools/report.h"

#include "texture/mesh_stats.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fluidtex::tools {
namespace {

using nlohmann::ordered_json;

std::int64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

// The value where `known`, else null: what is not known is never invented.
template <typename T>
ordered_json orNull(bool known, T value) {
  return known ? ordered_json(value) : ordered_json(nullptr);
}

}  // namespace

std::string frameRecord(const sim::Frame& frame, const texture::TexturedSurface& surface,
                        std::optional<int> singularities, const texture::SynthesisStats& synthesis,
                        const StageSeconds& seconds) {
  const texture::MeshStats mesh = texture::meshStats(surface.positions, surface.triangles);
  const bool textured = !surface.empty();
  ordered_json record;
  record["frame"] = frame.index;
  record["time"] = frame.time;
  record["substeps"] = frame.substeps.size();
  record["dt_min"] = orNull(!frame.substeps.empty(), frame.stats.dtMin);
  record["cells"] = frame.stats.cells;
  record["volume"] = frame.stats.volume;
  record["vertices"] = surface.positions.size();
  record["triangles"] = surface.triangles.size();
  record["components"] = mesh.components;
  record["edge_mean"] = orNull(textured, mesh.edgeMean);
  record["edge_cv"] = orNull(textured, mesh.edgeCv);
  record["singularities"] = orNull(singularities.has_value(), singularities.value_or(0));
  record["energy_start"] = orNull(textured, synthesis.energyStart);
  record["energy_end"] = orNull(textured, synthesis.energyEnd);
  record["iterations"] = orNull(textured, synthesis.iterations);
  record["renewed"] = orNull(textured, synthesis.renewed);
  record["likeness"] = nullptr;
  record["sharpness"] = nullptr;
  record["change_along_flow"] = nullptr;
  record["seconds"] = {{"simulate", seconds.simulate},   {"prepare", seconds.prepare},
                       {"transport", seconds.transport}, {"synthesize", seconds.synthesize},
                       {"render", seconds.render},       {"write", seconds.write}};
  record["peak_rss"] = peakMemory();
  return record.dump();
}

std::string toJson(const Report& report) {
  ordered_json json;
  json["version"] = FLUIDTEX_VERSION;
  json["scene"] = ordered_json::parse(report.scene);
  json["seed"] = report.seed;
  json["threads"] = report.threads;
  json["frames"] = ordered_json::array();
  for (const std::string& frame : report.frames) json["frames"].push_back(ordered_json::parse(frame));
  return json.dump(2) + "\n";
}

Report parseReport(const std::string& text) {
  try {
    const ordered_json json = ordered_json::parse(text);
    Report report;
    report.scene = json.at("scene").dump();
    report.seed = json.at("seed").get<std::uint64_t>();
    report.threads = json.at("threads").get<int>();
    for (const auto& frame : json.at("frames")) report.frames.push_back(frame.dump());
    return report;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("run.json of the state is damaged: ") + error.what());
  }
}

std::string sceneDifference(const std::string& before, const std::string& now) {
  const auto flat = [](const std::string& text) {
    nlohmann::json json = nlohmann::json::parse(text);
    json.erase("frames");
    return json.flatten();
  };
  const nlohmann::json old = flat(before), current = flat(now);
  const auto shown = [](const nlohmann::json& json, const std::string& key) {
    return json.contains(key) ? json.at(key).dump() : std::string("not there");
  };
  for (const nlohmann::json* side : {&old, &current})
    for (const auto& [key, value] : side->items()) {
      const std::string a = shown(old, key), b = shown(current, key);
      if (a == b) continue;
      std::string dotted = key.substr(1);
      for (char& c : dotted)
        if (c == '/') c = '.';
      return dotted + " was " + a + " and is " + b;
    }
  return {};
}

}  // namespace fluidtex::tools
