#include "tools/summaries/compare_table.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>

namespace fluidtex::tools {
namespace {

using Json = nlohmann::ordered_json;
using Figure = std::optional<double> Compared::*;

struct TableColumn {
  const char* key;
  const char* title;
  Figure figure;
};
const TableColumn kColumns[] = {{"likeness", "likeness", &Compared::likeness},
                                {"sharpness", "sharpness", &Compared::sharpness},
                                {"change_along_flow", "change along the flow", &Compared::alongFlow},
                                {"pop", "pops", &Compared::pop},
                                {"warp", "warp error", &Compared::warp},
                                {"shape", "stretch", &Compared::shape},
                                {"renewed", "renewed", &Compared::renewed},
                                {"seconds", "transport and synthesis, s a frame", &Compared::seconds}};

Json readReport(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Json report = Json::parse(stream, nullptr, false);
  if (!report.is_object() || !report.contains("frames"))
    throw std::runtime_error(file.string() + ": is not there, or no report of a run");
  return report;
}

// Over the frames after the first that has a surface, as far as they know it.
std::optional<double> meanOf(const Json& frames, const std::string& pointer) {
  double sum = 0.0;
  int count = 0;
  bool first = true;
  for (const Json& frame : frames) {
    if (frame.value("vertices", 0) == 0) continue;
    const Json value = frame.value(Json::json_pointer(pointer), Json());
    if (!first && value.is_number()) {
      sum += value.get<double>();
      ++count;
    }
    first = false;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace

Compared comparedRun(const std::string& label, const std::filesystem::path& out) {
  const Json report = readReport(out / "run.json"), &frames = report.at("frames");
  Compared row;
  row.label = label;
  row.renewed = meanOf(frames, "/renewed");
  const auto transport = meanOf(frames, "/seconds/transport"),
             synthesize = meanOf(frames, "/seconds/synthesize");
  if (transport && synthesize) row.seconds = *transport + *synthesize;
  if (!std::filesystem::exists(out / "measure.json")) return row;
  const Json measured = readReport(out / "measure.json"), mean = measured.value("mean", Json::object());
  const auto figure = [&](const char* key) {
    return mean.contains(key) ? std::optional(mean.at(key).get<double>()) : std::nullopt;
  };
  row.likeness = figure("likeness");
  row.sharpness = figure("sharpness");
  row.alongFlow = figure("change_along_flow");
  row.pop = figure("pop");
  row.warp = figure("warp");
  row.shape = figure("shape");
  return row;
}

std::string toJson(const std::vector<Compared>& rows) {
  Json json = Json::array();
  for (const Compared& row : rows) {
    Json object{{"variant", row.label}};
    for (const TableColumn& column : kColumns) {
      const std::optional<double>& value = row.*column.figure;
      object[column.key] = value ? Json(*value) : Json(nullptr);
    }
    json.push_back(std::move(object));
  }
  return json.dump(2) + "\n";
}

std::string toMarkdown(const std::vector<Compared>& rows) {
  std::string head = "| variant |", line = "|---|", body;
  for (const TableColumn& column : kColumns) {
    head += fmt::format(" {} |", column.title);
    line += "---|";
  }
  for (const Compared& row : rows) {
    body += fmt::format("| {} |", row.label);
    for (const TableColumn& column : kColumns) {
      const std::optional<double>& value = row.*column.figure;
      body += value ? fmt::format(" {:.3g} |", *value) : " - |";
    }
    body += "\n";
  }
  return head + "\n" + line + "\n" + body;
}

}  // namespace fluidtex::tools
