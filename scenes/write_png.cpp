#include "scenes/write_png.h"

#include <OpenImageIO/filesystem.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <vector>

namespace fluidtex::scenes {
namespace {

// Why it cannot be written; empty where it was.
std::string faultOf(const std::string& file, const OIIO::ImageSpec& spec, const void* pixels) {
  // In memory first: the library does not look whether the disk takes every byte.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(file, &memory);
  if (!output) return OIIO::geterror();
  if (!output->open(file, spec) || !output->write_image(spec.format, pixels) || !output->close()) {
    const std::string why = output->geterror();
    return why.empty() ? "the library does not say why" : why;
  }
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  out.close();
  return out ? std::string() : std::string(std::strerror(errno));
}

}  // namespace

bool writePng(const std::string& file, const OIIO::ImageSpec& spec, const void* pixels) {
  const std::string fault = faultOf(file, spec, pixels);
  if (fault.empty()) return true;
  std::cerr << file << ": cannot be written: " << fault << "\n";
  return false;
}

}  // namespace fluidtex::scenes
