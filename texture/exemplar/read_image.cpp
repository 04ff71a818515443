#include "texture/exemplar/read_image.h"

#include "foreign/picture.h"
#include "texture/exemplar/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>

namespace fluidtex::texture {
namespace {

using foreign::Curve;
using foreign::Picture;
using foreign::Sample;

// Where pixel (x, y) of the upright picture is stored, for the eight TIFF/EXIF orientations.
std::size_t storedAt(int orientation, int x, int y, int width, int height) {
  const int right = width - 1 - x, bottom = height - 1 - y;
  int column = x, row = y, columns = width;
  switch (orientation) {
    case 2:
      column = right;
      break;
    case 3:
      column = right, row = bottom;
      break;
    case 4:
      row = bottom;
      break;
    case 5:
      column = y, row = x, columns = height;
      break;
    case 6:
      column = y, row = right, columns = height;
      break;
    case 7:
      column = bottom, row = right, columns = height;
      break;
    case 8:
      column = bottom, row = x, columns = height;
      break;
    default:
      break;
  }
  return std::size_t(row) * std::size_t(columns) + std::size_t(column);
}

// Turns the reader's error into one sentence.
Picture pictureIn(const std::filesystem::path& file, Picture (*read)(const std::filesystem::path&)) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw ExemplarError(name + " does not exist.");
  if (std::filesystem::is_directory(status)) throw ExemplarError(name + " is a folder, not an image.");
  if (!std::filesystem::is_regular_file(status)) throw ExemplarError(name + " is no file of an image.");
  try {
    return read(file);
  } catch (const foreign::Unreadable& wrong) {
    throw ExemplarError(name + " " + wrong.what() + ".");
  }
}

// The upright picture, integers as 0..1.
struct Upright {
  const Picture& picture;

  bool turned() const { return picture.orientation >= 5 && picture.orientation <= 8; }
  int width() const { return turned() ? picture.height : picture.width; }
  int height() const { return turned() ? picture.width : picture.height; }
  bool alpha() const { return picture.channels == 2 || picture.channels == 4; }
  int colors() const { return picture.channels < 3 ? 1 : 3; }

  // Writes `channels` values.
  void at(int x, int y, float* out) const {
    const std::size_t first =
        storedAt(picture.orientation, x, y, width(), height()) * std::size_t(picture.channels);
    const char* from = picture.samples.data() + first * picture.sampleSize();
    for (int c = 0; c < picture.channels; ++c, from += picture.sampleSize())
      out[c] = foreign::shareAt(from, picture.sample);
  }
};

float toLinear(const Picture& picture, float value) {
  if (picture.curve == Curve::srgb) return decodeSrgb(value);
  if (picture.curve == Curve::power) return std::copysign(std::pow(std::abs(value), picture.exponent), value);
  return value;
}

// Linear value of each storable integer, since decoding needs a power function; empty for floats.
std::vector<float> tableOf(const Picture& picture) {
  if (picture.sample == Sample::real) return {};
  std::vector<float> table(picture.sample == Sample::byte ? 256 : 65536);
  const float step = 1.0f / float(table.size() - 1);
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = toLinear(picture, float(i) * step);
  return table;
}

void checkFinite(const Image& image, const std::string& name) {
  if (!std::all_of(image.data.begin(), image.data.end(), [](float value) { return std::isfinite(value); }))
    throw ExemplarError(name + " holds values that are not finite numbers.");
}

}  // namespace

Image readImage(const std::filesystem::path& file) {
  const Picture picture = pictureIn(file, foreign::readColors);
  const Upright upright{picture};
  const std::vector<float> table = tableOf(picture);
  const float steps = float(table.size()) - 1.0f;
  Image image{upright.width(), upright.height(), 4, {}};
  image.data.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      float in[4];
      upright.at(x, y, in);
      float* out = image.at(x, y);
      const float alpha = upright.alpha() ? in[picture.channels - 1] : 1.0f;
      out[3] = std::clamp(alpha, 0.0f, 1.0f);  // NaN passes, to be rejected below
      const bool asStored = picture.straight != 0 || alpha <= 0.0f || alpha == 1.0f;
      for (int c = 0; c < 3; ++c) {
        const float value = in[upright.colors() == 3 ? c : 0];
        if (asStored && !table.empty())
          out[c] = table[std::size_t(value * steps + 0.5f)];
        else
          out[c] = toLinear(picture, asStored ? value : value / alpha);
      }
    }
  });
  checkFinite(image, file.string());
  return image;
}

Image readMap(const std::filesystem::path& file, int channels) {
  const Picture picture = pictureIn(file, foreign::readNumbers);
  const Upright upright{picture};
  Image image{upright.width(), upright.height(), channels > 0 ? channels : upright.colors(), {}};
  image.data.reserve(std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float in[4];
      upright.at(x, y, in);
      for (int c = 0; c < image.channels; ++c) image.data.push_back(in[upright.colors() == 3 ? c : 0]);
    }
  checkFinite(image, file.string());
  return image;
}

}  // namespace fluidtex::texture
