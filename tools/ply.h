// The textured surface as a PLY file, for Blender and every other program; the properties are listed in
// docs/reference/files.md.
#pragma once

#include "texture/surface.h"

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// Binary little endian. Colours are written as sRGB bytes, exemplar coordinates as 0..1 from the top left
// corner. Throws std::system_error when the file cannot be written.
void writePly(const texture::TexturedSurface& surface, const std::filesystem::path& file);

}  // namespace fluidtex::tools
