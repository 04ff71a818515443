// Heights from an image file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fluidtex::sim {

// Thrown by readHeights() and by its callers; names the file and what is wrong.
struct HeightError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Heights as fractions of white, 0 to 1, rows from the picture's top.
struct HeightImage {
  int width = 0, height = 0;
  std::vector<float> values;  // height x width
};

// Reads the first channel as it is stored: integers as fractions of white, floats unchanged; not multiplied
// by alpha, upright by the file's orientation tag. Reads any kind of picture, in a process of its own
// (foreign/picture.h). Pixels that a TIFF marks as without data (GDAL_NODATA) get the height of the nearest
// one with data.
// Throws HeightError where the file is missing, is no picture, is damaged, has fewer than 2 x 2 pixels, or
// has values that are no heights.
HeightImage readHeights(const std::filesystem::path& file);

}  // namespace fluidtex::sim
