// Warnings about a scene's pictures.
#pragma once

#include "texture/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

// One sentence for each colour picture whose colour profile cannot be applied. Reads only the beginning of
// each file; unreadable ones are reported when they are read.
std::vector<std::string> imageNotes(const std::vector<std::filesystem::path>& pictures);

// A scene's colour pictures: its exemplar, and a finer picture of it.
std::vector<std::filesystem::path> colorPictures(const texture::ExemplarOptions& options);

}  // namespace fluidtex::tools
