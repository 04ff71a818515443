#include "tools/sheet/draw_sheet.h"

#include "tools/base/atomic_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <stdexcept>

namespace fluidtex::tools {
namespace {

using OIIO::ImageBuf;
namespace Algo = OIIO::ImageBufAlgo;

constexpr int kGap = 4;  // between pictures, pixels
constexpr const char* kFont = "DejaVuSans";

void demand(bool done, const std::filesystem::path& file, const ImageBuf& image) {
  if (!done) throw std::runtime_error(file.string() + ": " + image.geterror());
}

// Letters with a dark rim, legible on every picture. Without the font the sheet goes unlabelled.
void drawLabel(ImageBuf& sheet, int x, int y, int size, const std::string& label) {
  const float white[3] = {1.0f, 1.0f, 1.0f};
  constexpr int kRim = 2;
  if (!label.empty() && !Algo::render_text(sheet, x, y, label, size, kFont, white, Algo::TextAlignX::Left,
                                           Algo::TextAlignY::Top, kRim))
    sheet.geterror();
}

}  // namespace

void drawSheet(const ContactSheet& wanted) {
  const auto& [pictures, columns, width, file] = wanted;
  if (pictures.empty())
    throw std::runtime_error(file.string() + ": there are no pictures to put side by side");
  int height = 0;
  ImageBuf sheet;
  const int rows = (int(pictures.size()) + columns - 1) / columns;
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    ImageBuf picture(pictures[n].file.string());
    demand(picture.read(0, 0, true, OIIO::TypeDesc::FLOAT), pictures[n].file, picture);
    if (n == 0) {
      height = std::max(2, width * picture.spec().height / picture.spec().width);
      // Even sizes, as the video needs them.
      const OIIO::ImageSpec spec((columns * (width + kGap) + 1) / 2 * 2, (rows * (height + kGap) + 1) / 2 * 2,
                                 3, OIIO::TypeDesc::FLOAT);
      sheet.reset(spec, OIIO::InitializePixels::Yes);
    }
    const OIIO::ROI roi(0, width, 0, height, 0, 1, 0, 3);
    ImageBuf small;
    demand(Algo::resize(small, picture, "", 0.0f, roi), pictures[n].file, small);
    const int x = int(n) % columns * (width + kGap), y = int(n) / columns * (height + kGap);
    demand(Algo::paste(sheet, x, y, 0, 0, small), pictures[n].file, sheet);
    drawLabel(sheet, x + width / 40, y + width / 40, std::max(10, width / 20), pictures[n].label);
  }
  sheet.specmod().attribute("oiio:ColorSpace", "sRGB");
  sheet.specmod().attribute("CompressionQuality", 88);
  // Into memory: the library does not say when the disk refuses the last bytes.
  std::vector<unsigned char> encoded;
  OIIO::Filesystem::IOVecOutput memory(encoded);
  sheet.set_write_ioproxy(&memory);
  demand(sheet.write(file.string(), OIIO::TypeDesc::UINT8), file, sheet);
  writeTextAtomically(file, {reinterpret_cast<const char*>(encoded.data()), encoded.size()});
}

}  // namespace fluidtex::tools
