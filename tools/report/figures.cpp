#include "tools/report/figures.h"

#include "tools/report/scene_text.h"

#include <algorithm>
#include <string>

namespace fluidtex::tools {
namespace {

using Pointer = Json::json_pointer;

// Keys of a frame's record.
constexpr const char* kPlotted[] = {"volume",    "deficit", "vertices", "triangles", "substeps",
                                    "explained", "renewed", "likeness", "pop",       "peak_rss"};

Json numberAt(const Json& json, const Pointer& at, const Json& otherwise = nullptr) {
  return json.contains(at) && json.at(at).is_number() ? json.at(at) : otherwise;
}

std::string textAt(const Json& json, const Pointer& at) {
  return json.contains(at) && json.at(at).is_string() ? json.at(at).get<std::string>() : std::string();
}

Json pointAt(const Json& json, const Pointer& at, const Json& otherwise) {
  if (!json.contains(at) || !json.at(at).is_array() || json.at(at).size() != 3) return otherwise;
  const Json& point = json.at(at);
  return std::all_of(point.begin(), point.end(), [](const Json& x) { return x.is_number(); }) ? point
                                                                                              : otherwise;
}

Json frameOf(const Json& record) {
  Json frame;
  frame["frame"] = record["frame"];
  frame["time"] = numberAt(record, Pointer("/time"), 0.0);
  for (const char* key : kPlotted) frame[key] = numberAt(record, Pointer() / key);
  frame["seconds"] = Json::object();
  if (const auto seconds = record.find("seconds"); seconds != record.end() && seconds->is_object())
    for (const auto& [stage, value] : seconds->items())
      if (value.is_number()) frame["seconds"][stage] = value;
  return frame;
}

// Each once, in order. A line of the log: [date] [fluidtex] [warning] TEXT.
Json warningsIn(std::string_view log) {
  constexpr std::string_view kMark = "] [warning] ";
  Json warnings = Json::array();
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    const std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    const std::size_t at = line.find(kMark);
    if (!line.starts_with('[') || at == line.npos) continue;
    const Json warning = std::string(line.substr(at + kMark.size()));
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  }
  return warnings;
}

}  // namespace

Json figuresOf(const Json& report, std::string_view log) {
  const Json scene = report.value("scene", Json::object());
  Json figures;
  figures["title"] = textAt(scene, Pointer("/name"));
  figures["version"] = textAt(report, Pointer("/version"));
  figures["quality"] = textAt(scene, Pointer("/quality"));
  figures["seed"] = numberAt(report, Pointer("/seed"));
  figures["threads"] = numberAt(report, Pointer("/threads"), 1);
  figures["total"] = numberAt(scene, Pointer("/frames"), 0);
  figures["rate"] = numberAt(scene, Pointer("/frame_rate"), 24.0);
  const Json width = numberAt(scene, Pointer("/render/size/0")),
             height = numberAt(scene, Pointer("/render/size/1"));
  figures["aspect"] = width.is_null() || height.is_null() || height == 0
                          ? Json(nullptr)
                          : Json(width.get<double>() / height.get<double>());
  figures["camera"] = {{"from", pointAt(scene, Pointer("/camera/from"), {1.0, -1.0, 0.5})},
                       {"at", pointAt(scene, Pointer("/camera/at"), {0.0, 0.0, 0.0})},
                       {"fov", numberAt(scene, Pointer("/camera/fov"), 30.0)}};
  figures["scene"] = sceneText(scene);
  figures["warnings"] = warningsIn(log);
  figures["frames"] = Json::array();
  for (const Json& record : report.value("frames", Json::array()))
    if (record.is_object() && record.contains("frame") && record["frame"].is_number_integer())
      figures["frames"].push_back(frameOf(record));
  return figures;
}

}  // namespace fluidtex::tools
