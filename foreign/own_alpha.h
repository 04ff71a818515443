// Whether the fourth byte of a pixel is alpha.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::foreign {

// BMP and TGA files of 32 bits a pixel often only pad each pixel to four bytes. False where the file's header
// does not say that there is alpha; true for all other kinds of files. `kind`: as the image library calls it.
bool saysAlpha(const std::filesystem::path& file, const std::string& kind);

}  // namespace fluidtex::foreign
