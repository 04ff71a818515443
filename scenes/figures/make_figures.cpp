// make_figures FOLDER: writes the meshes that ship with the scenes into FOLDER, and their pictures.
#include "scenes/figures/vase.h"
#include "scenes/write_png.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: make_figures FOLDER, for example make_figures scenes/figures\n";
    return 1;
  }
  const std::string folder = std::string(argv[1]) + "/";
  std::ofstream(folder + "vase.obj", std::ios::binary)
      << fluidtex::figures::objOf(fluidtex::figures::makeVase()) << std::flush;
  constexpr int kSize = 1024;
  OIIO::ImageSpec spec(kSize, kSize, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  const bool written =
      fluidtex::scenes::writePng(folder + "vase.png", spec, fluidtex::figures::makeVasePicture(kSize).data());
  std::cout << folder << "vase.obj\n" << folder << "vase.png\n";
  return written ? 0 : 2;
}
