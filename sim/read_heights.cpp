#include "sim/read_heights.h"

#include "sim/no_data.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

namespace fluidtex::sim {

namespace {

constexpr int kLargestSide = 16384;

// No height, in shares of white or in metres, but what programs write where there is none.
constexpr float kNoHeight = 1e30f;

// Formats whose readers in the library fall over damaged files, by their first bytes.
void refuseFragile(const std::string& name, const std::string& start) {
  using namespace std::string_view_literals;
  constexpr std::array kFragile{std::pair("\x01\xDA"sv, "SGI"), std::pair("SDPX"sv, "DPX"),
                                std::pair("XPDS"sv, "DPX"), std::pair("GIF8"sv, "GIF"),
                                std::pair("\x80\x2A\x5F\xD7"sv, "Cineon")};
  for (const auto& [bytes, format] : kFragile)
    if (start.starts_with(bytes))
      throw HeightError(name + ": is of format " + format +
                        "; heights are read from PNG, TIFF, OpenEXR, PGM and the like");
}

// Where the pixel at (x, y) of the upright picture is stored, for the eight orientations of TIFF and EXIF.
// width, height: of the picture as it is stored.
std::size_t storedAt(int orientation, int x, int y, int width, int height) {
  if (orientation >= 5 && orientation <= 8) std::swap(x, y);
  if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) x = width - 1 - x;
  if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) y = height - 1 - y;
  return std::size_t(y) * std::size_t(width) + std::size_t(x);
}

HeightImage upright(HeightImage stored, int orientation) {
  if (orientation < 2 || orientation > 8) return stored;
  HeightImage image{stored.width, stored.height, std::vector<float>(stored.values.size())};
  if (orientation >= 5) std::swap(image.width, image.height);
  std::size_t n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.values[n++] = stored.values[storedAt(orientation, x, y, stored.width, stored.height)];
  return image;
}

// The largest number of a type that is read as a share of it; 1 of floats.
double whiteOf(OIIO::TypeDesc format) {
  switch (format.basetype) {
    case OIIO::TypeDesc::UINT8:
      return std::numeric_limits<std::uint8_t>::max();
    case OIIO::TypeDesc::INT8:
      return std::numeric_limits<std::int8_t>::max();
    case OIIO::TypeDesc::UINT16:
      return std::numeric_limits<std::uint16_t>::max();
    case OIIO::TypeDesc::INT16:
      return std::numeric_limits<std::int16_t>::max();
    case OIIO::TypeDesc::UINT32:
      return std::numeric_limits<std::uint32_t>::max();
    case OIIO::TypeDesc::INT32:
      return std::numeric_limits<std::int32_t>::max();
    default:
      return 1.0;
  }
}

// Which values say that there is no height. Several programs write another number than the one they name
// where it is as large as none is.
std::vector<char> missing(const HeightImage& image, double noData, double white) {
  // The lowest number of a type with a sign is read as -1.
  const double share = white > 1.0 ? std::max(noData / white, -1.0) : noData;
  const double tolerance = white > 1.0 ? 0.4 / white : 1e-6 * std::abs(noData);
  std::vector<char> missing(image.values.size());
  std::transform(image.values.begin(), image.values.end(), missing.begin(), [&](float v) {
    return char(std::isnan(noData) ? std::isnan(v)
                                   : std::abs(v - share) <= tolerance || std::abs(v) >= kNoHeight);
  });
  return missing;
}

// Gives pixels without a height that of the nearest one that has, in steps from pixel to pixel.
void fill(HeightImage& image, std::vector<char> missing) {
  const auto width = std::size_t(image.width);
  std::vector<std::size_t> front;
  for (std::size_t n = 0; n < missing.size(); ++n) {
    const bool beside = (n % width > 0 && missing[n - 1]) || (n % width + 1 < width && missing[n + 1]) ||
                        (n >= width && missing[n - width]) ||
                        (n + width < missing.size() && missing[n + width]);
    if (!missing[n] && beside) front.push_back(n);
  }
  while (!front.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t n : front) {
      const auto offer = [&](bool exists, std::size_t neighbor) {
        if (!exists || !missing[neighbor]) return;
        missing[neighbor] = 0;
        image.values[neighbor] = image.values[n];
        next.push_back(neighbor);
      };
      offer(n % width > 0, n - 1);
      offer(n % width + 1 < width, n + 1);
      offer(n >= width, n - width);
      offer(n + width < missing.size(), n + width);
    }
    front = std::move(next);
  }
}

}  // namespace

HeightImage readHeights(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw HeightError(name + ": no such file");
  if (!std::filesystem::is_regular_file(file)) throw HeightError(name + ": not a file");
  std::string start(4, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), std::streamsize(start.size()));
  refuseFragile(name, start);

  // Else heights would be multiplied by alpha.
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(name, &hints);
  const auto because = [](std::string reason) {
    reason = reason.substr(0, reason.find_last_not_of(" \r\n") + 1);
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return reason.empty() ? reason : ": " + reason;
  };
  if (!input) throw HeightError(name + ": cannot be read as an image" + because(OIIO::geterror()));
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width < 2 || spec.height < 2 || spec.depth > 1 || spec.deep || spec.nchannels < 1)
    throw HeightError(name + ": is no picture of at least 2 x 2 pixels");
  if (spec.width > kLargestSide || spec.height > kLargestSide)
    throw HeightError(name + ": is larger than " + std::to_string(kLargestSide) + " pixels a side");
  // No packing holds more in a byte.
  constexpr double kMostPerByte = 16384.0;
  if (double(spec.width) * spec.height > kMostPerByte * double(std::filesystem::file_size(file)))
    throw HeightError(name + ": is damaged or cut short: it says it has " + std::to_string(spec.width) +
                      " x " + std::to_string(spec.height) + " pixels");
  HeightImage image{spec.width, spec.height,
                    std::vector<float>(std::size_t(spec.width) * std::size_t(spec.height))};
  if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, image.values.data()))
    throw HeightError(name + ": is damaged or cut short" + because(input->geterror()));

  const std::optional<double> noData = noDataOf(file);
  if (noData) {
    const std::vector<char> none = missing(image, *noData, whiteOf(spec.format));
    if (std::find(none.begin(), none.end(), 0) == none.end())
      throw HeightError(name + ": has no height anywhere, all pixels are marked as without data");
    fill(image, none);
  }
  const auto wrong = std::find_if(image.values.begin(), image.values.end(),
                                  [](float v) { return !(std::abs(v) < kNoHeight); });
  if (wrong != image.values.end()) {
    const auto n = static_cast<int>(wrong - image.values.begin());
    std::ostringstream text;
    text << name << ": holds a value that is "
         << (std::isfinite(*wrong) ? "no height: " : "not a finite number: ") << *wrong << " in column "
         << n % image.width + 1 << " of row " << n / image.width + 1
         << "; where there is no height, a TIFF can say so (GDAL_NODATA)";
    throw HeightError(text.str());
  }
  return upright(std::move(image), spec.get_int_attribute("Orientation", 1));
}

}  // namespace fluidtex::sim
