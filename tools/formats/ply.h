// Writes the textured surface as a PLY file; its properties are listed in docs/reference/files.md.
#pragma once

#include "texture/joints/joints.h"

#include <filesystem>
#include <string>

namespace fluidtex::tools {

// Binary little endian. Colours are sRGB bytes, exemplar coordinates 0..1 from the top left corner. joints:
// findJoints() of the surface; none where colours are not looked up at coordinates. Throws std::system_error
// if the file cannot be written.
void writePly(const texture::TexturedSurface& surface, const texture::Joints& joints,
              const std::filesystem::path& file);

}  // namespace fluidtex::tools
