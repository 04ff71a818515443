// PNG files of the programs that make what ships with the scenes.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace fluidtex::scenes {

// Writes an image as `spec` describes it; `pixels` in its format, row by row. When that fails, says so on
// stderr and returns false.
bool writePng(const std::string& file, const OIIO::ImageSpec& spec, const void* pixels);

}  // namespace fluidtex::scenes
