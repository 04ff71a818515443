#include "scenes/write_png.h"

#include <iostream>

namespace fluidtex::scenes {

bool writePng(const std::string& file, const OIIO::ImageSpec& spec, const void* pixels) {
  const auto output = OIIO::ImageOutput::create(file);
  if (output && output->open(file, spec) && output->write_image(spec.format, pixels) && output->close())
    return true;
  std::cerr << file << ": cannot be written: " << (output ? output->geterror() : OIIO::geterror()) << "\n";
  return false;
}

}  // namespace fluidtex::scenes
