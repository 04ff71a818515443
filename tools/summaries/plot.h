// Plots curves with gnuplot.
#pragma once

#include "tools/validation/case.h"

#include <filesystem>

namespace fluidtex::tools {

// Writes the plot as an SVG file, atomically. Throws std::runtime_error if gnuplot is missing or fails.
void writePlot(const validation::Plot& plot, const std::filesystem::path& file);

}  // namespace fluidtex::tools
