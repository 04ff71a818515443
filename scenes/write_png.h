// Writes PNG files, for the programs that generate the shipped images.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace fluidtex::scenes {

// Writes an image described by `spec`, with `pixels` in its format, row by row. On failure prints to stderr
// and returns false.
bool writePng(const std::string& file, const OIIO::ImageSpec& spec, const void* pixels);

}  // namespace fluidtex::scenes
