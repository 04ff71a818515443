#include "foreign/webp_notes.h"

#include <OpenImageIO/tiffutils.h>
#include <webp/mux.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace fluidtex::foreign {

void addWebpNotes(const std::filesystem::path& file, OIIO::ImageSpec& spec) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const WebPData whole{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux(WebPMuxCreate(&whole, 0), WebPMuxDelete);
  if (!mux) return;
  WebPData chunk;
  if (WebPMuxGetChunk(mux.get(), "EXIF", &chunk) == WEBP_MUX_OK) {
    OIIO::string_view exif(reinterpret_cast<const char*>(chunk.bytes), chunk.size);
    // Some writers keep the header that JPEG has there.
    const OIIO::string_view header("Exif\0\0", 6);
    if (exif.size() > header.size() && exif.substr(0, header.size()) == header)
      exif.remove_prefix(header.size());
    OIIO::ImageSpec notes;
    OIIO::decode_exif(exif, notes);
    spec.attribute("Orientation", notes.get_int_attribute("Orientation", 1));
  }
  if (WebPMuxGetChunk(mux.get(), "ICCP", &chunk) == WEBP_MUX_OK && chunk.size > 0)
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(chunk.size)), chunk.bytes);
}

}  // namespace fluidtex::foreign
