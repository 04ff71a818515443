// Reads a textured surface from its PLY file.
#pragma once

#include "texture/surface.h"

#include <filesystem>

namespace fluidtex::tools {

// Reads the output of writePly() for an exemplar of that size (texels), with further maps and cross-fade.
// Gradients are zero if the file is of a version that did not write them; texture::recoverGradients()
// estimates them. Joints are passed over: texture::findJoints() finds them again. Throws UsageError that
// names the file if it is anything else.
texture::TexturedSurface readPly(const std::filesystem::path& file, int exemplarWidth, int exemplarHeight);

// Whether a surface that was read has no gradients.
bool lacksGradients(const texture::TexturedSurface& surface);

}  // namespace fluidtex::tools
