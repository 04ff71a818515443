#include "texture/read_image.h"

#include "texture/srgb.h"

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <system_error>

namespace fluidtex::texture {
namespace {

// 2^26 pixels: one gigabyte as linear RGBA, and as much again for each thing made from it.
constexpr std::int64_t kLargestArea = std::int64_t(1) << 26;

// Which of the file's channels are red, green and blue: by name, as files of many layers need, else the first
// ones.
struct ChannelOrder {
  int red = 0, green = 0, blue = 0, alpha = -1;
};

ChannelOrder channelOrder(const OIIO::ImageSpec& spec) {
  ChannelOrder order;
  // By name: the reader of GIF files gives a wrong index.
  order.alpha = spec.channelindex("A");
  const int red = spec.channelindex("R"), green = spec.channelindex("G"), blue = spec.channelindex("B");
  if (red >= 0 && green >= 0 && blue >= 0) return {red, green, blue, order.alpha};
  std::vector<int> color;
  for (int c = 0; c < spec.nchannels; ++c)
    if (c != order.alpha && spec.channelnames[std::size_t(c)] != "Z") color.push_back(c);
  if (color.empty()) return {0, 0, 0, -1};  // alpha alone: taken as grey
  if (color.size() < 3) return {color[0], color[0], color[0], order.alpha};
  return {color[0], color[1], color[2], order.alpha};
}

// How stored values become linear ones.
struct Transfer {
  enum Kind { linear, srgb, power } kind = linear;
  float exponent = 1.0f;

  float operator()(float value) const {
    if (kind == srgb) return decodeSrgb(value);
    if (kind == power) return std::copysign(std::pow(std::abs(value), exponent), value);
    return value;
  }
};

Transfer transferOf(const OIIO::ImageSpec& spec) {
  const bool isFloat = spec.format.is_floating_point();
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0.0f);
  if (OIIO::Strutil::iequals(space, "Linear") || OIIO::Strutil::istarts_with(space, "lin")) return {};
  if (OIIO::Strutil::istarts_with(space, "Gamma") && gamma > 0.0f) return {Transfer::power, gamma};
  // Readers call every file without a statement sRGB, which is wrong for floats.
  if (isFloat) return {};
  return {Transfer::srgb, 1.0f};
}

// Where the pixel at (x, y) of the upright picture is stored, for the eight orientations of TIFF and EXIF.
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

// An image as it is stored.
struct Stored {
  OIIO::ImageSpec spec;
  std::vector<float> data;
  bool straight = false;  // colours are not multiplied by alpha

  int orientation() const { return spec.get_int_attribute("Orientation", 1); }
  bool turned() const { return orientation() >= 5 && orientation() <= 8; }
  int width() const { return turned() ? spec.height : spec.width; }
  int height() const { return turned() ? spec.width : spec.height; }
  // The channels of a pixel of the upright picture.
  const float* at(int x, int y) const {
    return data.data() + storedAt(orientation(), x, y, width(), height()) * std::size_t(spec.nchannels);
  }
};

Stored readStored(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw ExemplarError(name + " does not exist.");
  if (std::filesystem::is_directory(status)) throw ExemplarError(name + " is a folder, not an image.");

  // Colours of transparent pixels are kept as they are stored; dividing them back would lose them.
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(name, &hints);
  if (!input) {
    OIIO::geterror();  // The library prints what nobody has fetched.
    throw ExemplarError(name + " cannot be read as an image.");
  }
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.deep || spec.depth > 1)
    throw ExemplarError(name + " is not a flat picture.");
  if (spec.width > kLargestSide || spec.height > kLargestSide ||
      std::int64_t(spec.width) * spec.height > kLargestArea)
    throw ExemplarError(name + " is too large: it has " + std::to_string(spec.width) + " x " +
                        std::to_string(spec.height) + " pixels, and at most " + std::to_string(kLargestSide) +
                        " a side and " + std::to_string(kLargestArea >> 20) + " million in all can be used.");
  Stored stored{spec, {}, false};
  stored.data.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, stored.data.data())) {
    input->geterror();
    throw ExemplarError(name + " is damaged or cut short.");
  }
  // Asked for after reading: that is when a reader knows whether the hint could be followed.
  stored.straight = input->spec().get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  return stored;
}

void checkFinite(const Image& image, const std::string& name) {
  if (!std::all_of(image.data.begin(), image.data.end(), [](float value) { return std::isfinite(value); }))
    throw ExemplarError(name + " holds values that are not finite numbers.");
}

}  // namespace

Image readImage(const std::filesystem::path& file) {
  const Stored stored = readStored(file);
  const bool straight = stored.straight;
  const ChannelOrder order = channelOrder(stored.spec);
  const Transfer toLinear = transferOf(stored.spec);
  Image image{stored.width(), stored.height(), 4, {}};
  image.data.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const float* in = stored.at(x, y);
      float* out = image.at(x, y);
      const float alpha = order.alpha < 0 ? 1.0f : in[order.alpha];
      out[3] = std::clamp(alpha, 0.0f, 1.0f);  // passes on what is not a number, to be refused below
      const int index[3] = {order.red, order.green, order.blue};
      for (int c = 0; c < 3; ++c) {
        const float value = in[index[c]];
        out[c] = toLinear(straight || alpha <= 0.0f || alpha == 1.0f ? value : value / alpha);
      }
    }
  });
  checkFinite(image, file.string());
  return image;
}

Image readMap(const std::filesystem::path& file, int channels) {
  const Stored stored = readStored(file);
  const ChannelOrder order = channelOrder(stored.spec);
  const bool grey = order.red == order.green && order.green == order.blue;
  Image image{stored.width(), stored.height(), channels > 0 ? channels : grey ? 1 : 3, {}};
  image.data.reserve(std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels));
  const int index[3] = {order.red, order.green, order.blue};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) image.data.push_back(stored.at(x, y)[index[c]]);
  checkFinite(image, file.string());
  return image;
}

}  // namespace fluidtex::texture
