// Table of measures, to compare runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Means over the frames of a finished run; nothing where a measure is unknown.
struct Compared {
  std::string label;
  std::optional<double> likeness, sharpness, alongFlow, pop, warp,
      shape;                      // as `fluidtex measure` defines them
  std::optional<double> renewed;  // share of the vertices, on the frames after the first with a surface
  std::optional<double> seconds;  // of transport and synthesis, on these frames
};

// Reads OUT/run.json, and OUT/measure.json of `fluidtex measure` if it exists. Throws std::runtime_error if
// the first is missing or one is damaged.
Compared comparedRun(const std::string& label, const std::filesystem::path& out);

std::string toJson(const std::vector<Compared>& rows);
std::string toMarkdown(const std::vector<Compared>& rows);

}  // namespace fluidtex::tools
