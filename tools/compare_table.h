// The figures of runs that are set side by side.
#pragma once

#include "texture/options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Means over the frames of a finished run, the first surface left out; nothing where a figure is not known.
struct Compared {
  std::string label;
  std::optional<double> likeness, sharpness, change, pops;  // as `fluidtex measure` defines them
  std::optional<double> renewed;                            // share of the vertices
  std::optional<double> seconds;                            // of transport and synthesis, a frame
};

// Reads OUT/run.json. Throws std::runtime_error where that is missing or damaged.
Compared comparedRun(const std::string& label, const std::filesystem::path& out,
                     const texture::ExemplarOptions& exemplar);

std::string toJson(const std::vector<Compared>& rows);
std::string toMarkdown(const std::vector<Compared>& rows);

}  // namespace fluidtex::tools
