// Writes the textured surface as a PLY file; its properties are listed in docs/reference/files.md.
#pragma once

#include "texture/surface.h"

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// Binary little endian. Colours are sRGB bytes, exemplar coordinates 0..1 from the top left corner. Throws
// std::system_error if the file cannot be written.
void writePly(const texture::TexturedSurface& surface, const std::filesystem::path& file);

}  // namespace fluidtex::tools
