// Contact sheet: labelled pictures in one picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

struct LabelledPicture {
  std::filesystem::path file;
  std::string label;  // in the upper left corner; empty: none
};

// `columns` pictures per row, left to right and top to bottom, each scaled to a width of `width` pixels and
// the height of the first picture's aspect ratio. sRGB, 8 bits; format by the extension of `file`.
struct ContactSheet {
  std::vector<LabelledPicture> pictures;
  int columns = 1, width = 1;
  std::filesystem::path file;
};

// Draws them by fluidtex_sheet, a program beside this one: the library that scales and letters pictures takes
// a third of a second to load. Throws std::runtime_error that names the picture that cannot be read, or the
// file that cannot be written.
void writeContactSheets(const std::vector<ContactSheet>& sheets);

}  // namespace fluidtex::tools
