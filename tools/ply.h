// The textured surface as a PLY file, for Blender and every other program; the properties are listed in
// docs/formats.md.
#pragma once

#include "texture/surface.h"

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// Binary little endian. Colours are written as sRGB bytes, exemplar coordinates as 0..1 from the top left
// corner. Throws std::system_error when the file cannot be written.
void writePly(const texture::TexturedSurface& surface, const std::filesystem::path& file);

// Reads back what writePly() wrote of a texture from an exemplar of that size (texels), with its maps and the
// place that fades; gradients, which the file does not hold, are zero. Throws UsageError that names the file
// where it is something else.
texture::TexturedSurface readPly(const std::filesystem::path& file, int exemplarWidth, int exemplarHeight);

}  // namespace fluidtex::tools
