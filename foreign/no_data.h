// The number that stands for "no height here" in a file.
#pragma once

#include <filesystem>
#include <optional>

namespace fluidtex::foreign {

// GDAL's tag 42113 of a TIFF, as it is written there: in units of the stored numbers. Nothing where the file
// has none, or is no TIFF.
std::optional<double> noDataOf(const std::filesystem::path& file);

}  // namespace fluidtex::foreign
