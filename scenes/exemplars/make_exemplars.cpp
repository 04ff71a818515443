// make_exemplars FOLDER: writes the example images that ship with the scenes into FOLDER.
#include "scenes/exemplars/lava.h"
#include "scenes/exemplars/scales.h"
#include "scenes/write_png.h"

#include <filesystem>
#include <iostream>

namespace {

bool write(const std::string& file, int size, const std::vector<std::uint8_t>& pixels) {
  OIIO::ImageSpec spec(size, size, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (!fluidtex::scenes::writePng(file, spec, pixels.data())) return false;
  std::cout << file << "\n";
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: make_exemplars FOLDER, for example make_exemplars scenes/exemplars\n";
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  const fluidtex::exemplars::Scales scales;
  const fluidtex::exemplars::Lava lava;
  const bool written = write((folder / "green_scales.png").string(), scales.size,
                             fluidtex::exemplars::makeGreenScales(scales)) &&
                       write((folder / "lava.png").string(), lava.size, fluidtex::exemplars::makeLava(lava));
  return written ? 0 : 2;
}
