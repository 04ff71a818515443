// make_terrain FOLDER: writes the height fields that ship with the scenes into FOLDER, as grey PNGs of 16
// bits.
#include "scenes/terrain/terrain.h"
#include "scenes/write_png.h"

#include <filesystem>
#include <iostream>
#include <string>

namespace {

bool write(const fluidtex::terrain::Ground& ground, double high, const std::string& file) {
  const auto pixels = fluidtex::terrain::greyValues(ground, 0.0, high);
  const OIIO::ImageSpec spec(ground.width, ground.height, 1, OIIO::TypeDesc::UINT16);
  if (!fluidtex::scenes::writePng(file, spec, pixels.data())) return false;
  std::cout << file << ": " << ground.pixel << " m a pixel, white is " << high << " m\n";
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: make_terrain FOLDER, for example make_terrain scenes/terrain\n";
    return 1;
  }
  const std::string folder = std::string(argv[1]) + "/";
  const bool done = write(fluidtex::terrain::streamBed(), 1.0, folder + "stream_bed.png") &&
                    write(fluidtex::terrain::mountain(), 1.5, folder + "mountain.png");
  return done ? 0 : 2;
}
