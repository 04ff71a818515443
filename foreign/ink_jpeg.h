// Photographs of four inks.
#pragma once

#include <filesystem>
#include <vector>

namespace fluidtex::foreign {

struct Inks {
  int width = 0, height = 0;
  std::vector<unsigned char> cmyk;  // height x width x 4; 255 is full
};

// The inks of a CMYK or YCCK JPEG. Files with Adobe's mark hold them inverted, others as they are; the image
// library takes all for inverted. Throws Unreadable.
Inks readInkJpeg(const std::filesystem::path& file);

}  // namespace fluidtex::foreign
