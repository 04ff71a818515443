// What a WebP file says of its picture besides the pixels.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>

namespace fluidtex::foreign {

// Adds the orientation and the colour profile, which the image library's reader of WebP leaves out, under the
// names that its other readers use.
void addWebpNotes(const std::filesystem::path& file, OIIO::ImageSpec& spec);

}  // namespace fluidtex::foreign
