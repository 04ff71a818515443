// A textured surface read back from its PLY file.
#pragma once

#include "texture/surface.h"

#include <filesystem>

namespace fluidtex::tools {

// Reads back what writePly() wrote of a texture from an exemplar of that size (texels), with its maps and the
// place that fades; gradients, which the file does not hold, are zero. Throws UsageError that names the file
// where it is something else.
texture::TexturedSurface readPly(const std::filesystem::path& file, int exemplarWidth, int exemplarHeight);

}  // namespace fluidtex::tools
