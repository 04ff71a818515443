// Heights from an image file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fluidtex::sim {

// Thrown by readHeights(), and by all that reads a height field through it; names the file and what is wrong.
struct HeightError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Shares of white, 0 to 1, rows from the picture's top.
struct HeightImage {
  int width = 0, height = 0;
  std::vector<float> values;  // height x width
};

// The first channel as it is stored, whole numbers (or floats, which are taken as they are), not multiplied
// by alpha, upright as the file's orientation tag says; of a picture of any kind, read in a process of its
// own (foreign/picture.h). Pixels that a TIFF marks as without data (GDAL_NODATA) get the height of the
// nearest one that has any. Throws HeightError: not there, no picture, damaged, of fewer than 2 x 2 pixels,
// or with values that are no heights.
HeightImage readHeights(const std::filesystem::path& file);

}  // namespace fluidtex::sim
