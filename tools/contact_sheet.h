// Pictures side by side, each with its name, as one picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

struct LabelledPicture {
  std::filesystem::path file;
  std::string label;  // in the upper left corner; none where empty
};

// `columns` pictures a row, from left to right and top to bottom, each scaled to `width` pixels and the
// height that the first picture's shape asks for. The format is that of the file's ending, sRGB, 8 bits.
// Throws std::runtime_error that names the picture that cannot be read, or the file that cannot be written.
void writeContactSheet(const std::vector<LabelledPicture>& pictures, int columns, int width,
                       const std::filesystem::path& file);

}  // namespace fluidtex::tools
