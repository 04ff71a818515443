// Reads a textured surface from its PLY file.
#pragma once

#include "texture/surface.h"

#include <filesystem>

namespace fluidtex::tools {

// Reads the output of writePly() for an exemplar of that size (texels), with further maps and cross-fade.
// Gradients, which the file does not hold, are zero. Throws UsageError that names the file if it is anything
// else.
texture::TexturedSurface readPly(const std::filesystem::path& file, int exemplarWidth, int exemplarHeight);

}  // namespace fluidtex::tools
