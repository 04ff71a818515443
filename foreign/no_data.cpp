#include "foreign/no_data.h"

#include <tiffio.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

namespace fluidtex::foreign {
namespace {

// GDAL_NODATA, a text; libtiff knows it as a tag without a name.
constexpr std::uint32_t kTag = 42113;

void sayNothing(const char*, const char*, va_list) {}

}  // namespace

std::optional<double> noDataOf(const std::filesystem::path& file) {
  // The library would tell of every tag without a name.
  const TIFFErrorHandler warn = TIFFSetWarningHandler(sayNothing), error = TIFFSetErrorHandler(sayNothing);
  std::optional<double> number;
  {
    const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFOpen(file.c_str(), "r"), [](TIFF* open) {
      if (open != nullptr) TIFFClose(open);
    });
    const TIFFField* field = tiff != nullptr ? TIFFFindField(tiff.get(), kTag, TIFF_ANY) : nullptr;
    std::uint32_t count = 0;
    const char* text = nullptr;
    if (field != nullptr && TIFFFieldDataType(field) == TIFF_ASCII && TIFFFieldPassCount(field) != 0 &&
        TIFFGetField(tiff.get(), kTag, &count, &text) != 0 && text != nullptr) {
      const std::string word(text, text + count);
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (end != word.c_str()) number = value;
    }
  }
  TIFFSetWarningHandler(warn);
  TIFFSetErrorHandler(error);
  return number;
}

}  // namespace fluidtex::foreign
