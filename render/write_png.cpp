#include "render/render.h"
#include "texture/exemplar/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace fluidtex::render {
namespace {

std::uint8_t encoded(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0f * texture::encodeSrgb(std::clamp(linear, 0.0f, 1.0f))));
}

}  // namespace

void writePng(const Picture& picture, const std::filesystem::path& file) {
  std::vector<std::uint8_t> bytes(picture.rgb.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bytes.size(), 1 << 14), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) bytes[i] = encoded(picture.rgb[i]);
  });

  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": the picture could not be written: " + why);
  };
  // By format, not by the file's ending: the caller's temporary name may end in anything.
  const auto output = OIIO::ImageOutput::create("png");
  if (!output) fail(OIIO::geterror());
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // Noise hardly packs: the low levels are nearly as small as the high ones and several times as fast.
  spec.attribute("png:compressionLevel", 3);
  // Into memory: the library does not say when the disk refuses the last bytes.
  std::vector<unsigned char> encodedFile;
  OIIO::Filesystem::IOVecOutput memory(encodedFile);
  if (!output->set_ioproxy(&memory)) fail(output->geterror());
  if (!output->open(file.string(), spec)) fail(output->geterror());
  if (!output->write_image(OIIO::TypeDesc::UINT8, bytes.data())) fail(output->geterror());
  if (!output->close()) fail(output->geterror());
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(encodedFile.data()),
            static_cast<std::streamsize>(encodedFile.size()));
  out.close();
  if (!out) fail(std::strerror(errno));
}

}  // namespace fluidtex::render
