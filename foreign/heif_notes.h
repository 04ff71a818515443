// What a HEIC or AVIF file says of its picture's colours.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>

namespace fluidtex::foreign {

// Adds the colour profile, or else the primaries, which the image library's reader of these files leaves out,
// under the names that its other readers use.
void addHeifNotes(const std::filesystem::path& file, OIIO::ImageSpec& spec);

}  // namespace fluidtex::foreign
