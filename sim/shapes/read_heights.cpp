#include "sim/shapes/read_heights.h"

#include "foreign/picture.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace fluidtex::sim {

namespace {

// Larger values, in fractions of white or in metres, are no heights but marks of missing data.
constexpr float kNoHeight = 1e30f;

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

// Shares of white.
std::vector<float> firstChannel(const foreign::Picture& picture) {
  const std::size_t count = std::size_t(picture.width) * std::size_t(picture.height),
                    step = picture.sampleSize() * std::size_t(picture.channels);
  std::vector<float> values(count);
  const char* from = picture.samples.data();
  for (float& value : values) {
    value = foreign::shareAt(from, picture.sample);
    from += step;
  }
  return values;
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

// Gives pixels without a height that of the nearest one with a height, in steps from pixel to pixel.
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
  foreign::Picture picture;
  try {
    picture = foreign::readHeights(file);
  } catch (const foreign::Unreadable& wrong) {
    throw HeightError(name + ": " + wrong.what());
  }
  if (picture.width < 2 || picture.height < 2)
    throw HeightError(name + ": is no picture of at least 2 x 2 pixels");
  HeightImage image{picture.width, picture.height, firstChannel(picture)};
  if (picture.hasNoData != 0) {
    const std::vector<char> none = missing(image, picture.noData, picture.white);
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
  return upright(std::move(image), picture.orientation);
}

}  // namespace fluidtex::sim
