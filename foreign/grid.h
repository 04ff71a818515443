// A grid of an OpenVDB file of others.
#pragma once

#include "foreign/ask.h"

#include <filesystem>
#include <string>

namespace fluidtex::foreign {

// The first grid of floats, or of float vectors, of the file, as an uncompressed stream of OpenVDB. Throws
// Unreadable.
std::string readGrid(const std::filesystem::path& file, bool vectors);

}  // namespace fluidtex::foreign
