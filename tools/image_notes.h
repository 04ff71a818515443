// What there is to say of a scene's pictures before they are used.
#pragma once

#include "texture/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

// One sentence for each picture of colours whose own colour profile cannot be followed. Only the beginning of
// each file is looked at; of what cannot be read at all, reading it tells.
std::vector<std::string> imageNotes(const std::vector<std::filesystem::path>& pictures);

// The pictures of colours that a scene has: its exemplar, and a finer picture of it.
std::vector<std::filesystem::path> colorPictures(const texture::ExemplarOptions& options);

}  // namespace fluidtex::tools
