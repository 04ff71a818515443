// A small copy of a picture.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// The PNG file as JPEG, `width` pixels wide at most, drawn by ffmpeg. Throws std::runtime_error that names
// the picture if it cannot be read, or ffmpeg is not there.
std::string previewOf(const std::filesystem::path& picture, int width);

}  // namespace fluidtex::tools
