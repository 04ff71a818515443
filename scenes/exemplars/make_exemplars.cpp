// make_exemplars FOLDER: writes the example images that ship with the scenes into FOLDER.
#include "scenes/exemplars/scales.h"

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: make_exemplars FOLDER, for example make_exemplars scenes/exemplars\n";
    return 1;
  }
  const fluidtex::exemplars::Scales options;
  const std::string file = (std::filesystem::path(argv[1]) / "green_scales.png").string();
  const auto pixels = fluidtex::exemplars::makeGreenScales(options);
  OIIO::ImageSpec spec(options.size, options.size, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  const auto output = OIIO::ImageOutput::create(file);
  if (!output || !output->open(file, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
      !output->close()) {
    std::cerr << file << ": cannot be written: " << (output ? output->geterror() : OIIO::geterror()) << "\n";
    return 2;
  }
  std::cout << file << "\n";
  return 0;
}
