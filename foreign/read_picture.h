// The reader's side of foreign/picture.h: called in a process that may come to harm.
#pragma once

#include "foreign/picture.h"

namespace fluidtex::foreign::here {

// `wanted`: colours, numbers or heights.
Picture readPicture(const std::filesystem::path& file, Wanted wanted);
std::string colorNote(const std::filesystem::path& file);

}  // namespace fluidtex::foreign::here
