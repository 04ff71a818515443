#include "foreign/read_picture.h"

#include "foreign/color_profile.h"
#include "foreign/heif_notes.h"
#include "foreign/ink_jpeg.h"
#include "foreign/layers.h"
#include "foreign/limits.h"
#include "foreign/no_data.h"
#include "foreign/own_alpha.h"
#include "foreign/webp_notes.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::foreign::here {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

// A file that is open, and what of it is to be read.
struct Opened {
  std::filesystem::path file;
  std::unique_ptr<OIIO::ImageInput> input;
  ImageSpec spec;  // of the part that is read
  Layer layer;
  bool inks = false;  // the layer's first four channels are cyan, magenta, yellow and black
  std::optional<ColorProfile> profile;
  std::string note;

  bool is(const char* kind) const { return std::strcmp(input->format_name(), kind) == 0; }
  std::size_t colors() const { return inks ? 4 : layer.channels.size() < 3 ? 1 : 3; }
  bool alpha() const { return layer.channels.size() > colors(); }
};

std::unique_ptr<OIIO::ImageInput> openFile(const std::filesystem::path& file, bool rawInks = false) {
  ImageSpec hints;
  // Colours of transparent pixels are kept as they are stored; dividing them back would lose them.
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (rawInks) hints.attribute("oiio:RawColor", 1);
  auto input = OIIO::ImageInput::open(file.string(), &hints);
  if (!input) {
    std::string why = OIIO::geterror();
    why.resize(std::min(why.find(". Is it a file format"), why.size()));  // one sentence, and no question
    throw Unreadable("cannot be read as an image: " + asClause(why));
  }
  return input;
}

// Of files whose channels have no names that tell: the first ones are the colours.
Layer plainLayer(const ImageSpec& spec) {
  // Alpha by name: the reader of GIF files gives a wrong index.
  const int alpha = spec.channelindex("A");
  std::vector<int> color;
  for (int c = 0; c < spec.nchannels; ++c)
    if (c != alpha && spec.channelnames[std::size_t(c)] != "Z") color.push_back(c);
  if (color.empty()) return {0, {0}};  // alpha alone: taken as grey
  color.resize(color.size() < 3 ? 1 : 3);
  const int red = spec.channelindex("R"), green = spec.channelindex("G"), blue = spec.channelindex("B");
  if (red >= 0 && green >= 0 && blue >= 0) color = {red, green, blue};
  if (alpha >= 0) color.push_back(alpha);
  return {0, color};
}

// The parts of an EXR, by their names.
std::vector<Part> partsOf(OIIO::ImageInput& input) {
  std::vector<Part> parts;
  for (int part = 0; input.seek_subimage(part, 0); ++part) {
    const ImageSpec& spec = input.spec();
    // Deep ones are no pictures.
    parts.push_back({spec.get_string_attribute("oiio:subimagename"),
                     spec.deep ? std::vector<std::string>{} : spec.channelnames});
  }
  input.geterror();  // that there is no further part
  return parts;
}

void checkSize(const ImageSpec& spec, Wanted wanted) {
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.deep || spec.depth > 1)
    throw Unreadable("is not a flat picture");
  const bool large = spec.width > kLargestSide || spec.height > kLargestSide;
  if (large && wanted == Wanted::heights)
    throw Unreadable("is too large: it has " + std::to_string(spec.width) + " x " +
                     std::to_string(spec.height) + " pixels, and at most " + std::to_string(kLargestSide) +
                     " a side can be used");
  if (large || (wanted != Wanted::heights && std::int64_t(spec.width) * spec.height > kLargestArea))
    throw Unreadable("is too large: it has " + std::to_string(spec.width) + " x " +
                     std::to_string(spec.height) + " pixels, and at most " + std::to_string(kLargestSide) +
                     " a side and " + std::to_string(kLargestArea >> 20) + " million in all can be used");
}

std::span<const unsigned char> profileIn(const ImageSpec& spec) {
  const OIIO::ParamValue* found = spec.find_attribute("ICCProfile");
  if (found == nullptr || found->datasize() < 1) return {};
  return {static_cast<const unsigned char*>(found->data()), std::size_t(found->datasize())};
}

// The primaries that an EXR or a HEIC names; nothing where they are those of sRGB.
std::optional<ColorProfile> primariesIn(const ImageSpec& spec) {
  float xy[8];
  const float srgb[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  if (!spec.getattribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), xy)) return std::nullopt;
  if (std::equal(xy, xy + 8, srgb, [](float a, float b) { return std::abs(a - b) < 1e-3f; }))
    return std::nullopt;
  return ColorProfile(std::span<const float, 8>(xy), !spec.format.is_floating_point());
}

// A TIFF of inks with a profile of inks is opened again for the inks themselves.
void openInks(Opened& opened) {
  if (!opened.is("tiff") || opened.alpha()) throw Unreadable("is for CMYK, and cannot be used here");
  opened.input = openFile(opened.file, true);
  if (opened.input->spec().nchannels != 4) throw Unreadable("is for CMYK, and the picture is not");
  opened.spec = opened.input->spec();
  opened.layer = {0, {0, 1, 2, 3}};
  opened.inks = true;
}

void findProfile(Opened& opened) {
  try {
    const auto icc = profileIn(opened.spec);
    if (icc.empty()) {
      opened.profile = primariesIn(opened.spec);
      return;
    }
    const std::vector<unsigned char> kept(icc.begin(), icc.end());
    if (profileChannels(icc) == 4 && !opened.inks) openInks(opened);
    opened.profile.emplace(kept, int(opened.colors()));
  } catch (const Unreadable& error) {
    opened.note = std::string("the colour profile in it ") + error.what() +
                  "; its colours are taken as sRGB, and may look different";
  }
}

Opened openPicture(const std::filesystem::path& file, Wanted wanted) {
  Opened opened{file, openFile(file), {}, {}, false, {}, {}};
  opened.spec = opened.input->spec();
  if (opened.is("openexr")) {
    opened.layer = chooseLayer(partsOf(*opened.input), wanted != Wanted::colors);
    if (!opened.input->seek_subimage(opened.layer.part, 0))
      throw Unreadable("is damaged: " + asClause(opened.input->geterror()));
    opened.spec = opened.input->spec();
  } else {
    opened.layer = plainLayer(opened.spec);
  }
  if (wanted == Wanted::heights) opened.layer.channels.resize(1);
  checkSize(opened.spec, wanted);
  if (opened.is("webp")) addWebpNotes(file, opened.spec);
  if (opened.is("heif")) addHeifNotes(file, opened.spec);
  if (opened.is("jpeg") && opened.spec.get_string_attribute("jpeg:ColorSpace") == "CMYK") {
    opened.inks = true;
    opened.layer = {0, {0, 1, 2, 3}};
  }
  if (wanted == Wanted::colors) findProfile(opened);
  return opened;
}

// The largest number of a type, which is read as 1.
double whiteOf(const TypeDesc& type) {
  switch (type.basetype) {
    case TypeDesc::UINT8:
      return std::numeric_limits<std::uint8_t>::max();
    case TypeDesc::INT8:
      return std::numeric_limits<std::int8_t>::max();
    case TypeDesc::UINT16:
      return std::numeric_limits<std::uint16_t>::max();
    case TypeDesc::INT16:
      return std::numeric_limits<std::int16_t>::max();
    case TypeDesc::UINT32:
      return std::numeric_limits<std::uint32_t>::max();
    case TypeDesc::INT32:
      return std::numeric_limits<std::int32_t>::max();
    default:
      return 1.0;
  }
}

void addNoData(const Opened& opened, PictureHead& head) {
  head.white = whiteOf(opened.spec.format);
  const std::optional<double> noData = opened.is("tiff") ? noDataOf(opened.file) : std::nullopt;
  head.hasNoData = noData.has_value();
  head.noData = noData.value_or(0.0);
}

// How stored values become linear ones, where no profile says.
void setCurve(const ImageSpec& spec, PictureHead& head) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0.0f);
  head.curve = Curve::linear;
  if (OIIO::Strutil::iequals(space, "Linear") || OIIO::Strutil::istarts_with(space, "lin")) return;
  if (OIIO::Strutil::istarts_with(space, "Gamma") && gamma > 0.0f) {
    head.curve = Curve::power;
    head.exponent = gamma;
    return;
  }
  // Readers call every file without a statement sRGB, which is wrong for floats.
  if (!spec.format.is_floating_point()) head.curve = Curve::srgb;
}

struct Window {
  int x = 0, y = 0, width = 0, height = 0;  // of what is stored
};

// What an EXR stores outside of its display window is there for filters to reach into, and is not shown.
Window shownOf(const Opened& opened) {
  const ImageSpec& spec = opened.spec;
  if (!opened.is("openexr")) return {0, 0, spec.width, spec.height};
  const auto end = [](int begin, int size) { return std::int64_t(begin) + size; };
  const int x = std::max(spec.x, spec.full_x), y = std::max(spec.y, spec.full_y);
  const std::int64_t right = std::min(end(spec.x, spec.width), end(spec.full_x, spec.full_width)),
                     bottom = std::min(end(spec.y, spec.height), end(spec.full_y, spec.full_height));
  if (right <= x || bottom <= y) throw Unreadable("has no pixels inside of its display window");
  return {x - spec.x, y - spec.y, int(right - x), int(bottom - y)};
}

// Channels first to last, band by band: a file that says much and holds little then takes little. Fewer rows
// than there are where it fails.
std::string readRows(Opened& opened, int first, int last, const TypeDesc& type) {
  constexpr std::size_t kBand = 4 << 20;  // bytes
  const ImageSpec& spec = opened.spec;
  const std::size_t row = std::size_t(spec.width) * std::size_t(last - first + 1) * type.size();
  const int unit = spec.tile_width > 0 ? std::max(1, spec.tile_height) : 64;
  const int rows = std::max(1, int(kBand / row) / unit) * unit;
  std::string all;
  all.reserve(row * std::size_t(spec.height));
  for (int y = 0; y < spec.height; y += rows) {
    const int end = std::min(y + rows, spec.height), part = opened.layer.part;
    const std::size_t before = all.size();
    all.resize(row * std::size_t(end));
    const bool read =
        spec.tile_width > 0
            ? opened.input->read_tiles(part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                                       spec.z + 1, first, last + 1, type, &all[before])
            : opened.input->read_scanlines(part, 0, spec.y + y, spec.y + end, spec.z, first, last + 1, type,
                                           &all[before]);
    if (read) continue;
    all.resize(before);
    break;
  }
  return all;
}

// The layer's channels inside of the window, each sample `size` bytes.
std::string samplesOf(Opened& opened, const Window& window, const TypeDesc& type) {
  const auto [first, last] = std::minmax_element(opened.layer.channels.begin(), opened.layer.channels.end());
  const std::size_t size = type.size(), stored = std::size_t(*last - *first + 1),
                    kept = opened.layer.channels.size(), row = std::size_t(opened.spec.width) * stored * size;
  std::string all = readRows(opened, *first, *last, type);
  const bool read = all.size() == row * std::size_t(opened.spec.height);
  // Readers of JPEG and TIFF call a file whose end is missing read, and fill the rest with grey or black.
  const std::string why = opened.input->geterror();
  const bool harmless = why.empty() || why.find("extraneous bytes") != why.npos;
  if (!read || !harmless)
    throw Unreadable("is damaged or cut short" + (why.empty() ? "" : ": " + asClause(why)));
  const bool inOrder =
      kept == stored && std::is_sorted(opened.layer.channels.begin(), opened.layer.channels.end());
  if (inOrder && window.width == opened.spec.width && window.height == opened.spec.height) return all;
  // To the front of the same memory: nothing is written before it is read, one pixel at a time.
  char* to = all.data();
  std::vector<char> pixel(kept * size);
  for (int y = 0; y < window.height; ++y) {
    const char* from = all.data() + std::size_t(window.y + y) * row + std::size_t(window.x) * stored * size;
    for (int x = 0; x < window.width; ++x, from += stored * size, to += kept * size) {
      for (std::size_t c = 0; c < kept; ++c)
        std::memcpy(&pixel[c * size], from + std::size_t(opened.layer.channels[c] - *first) * size, size);
      std::memcpy(to, pixel.data(), pixel.size());
    }
  }
  all.resize(std::size_t(to - all.data()));
  return all;
}

// Light instead of what the profile is for, with straight alpha.
void useProfile(const Opened& opened, bool whole, Picture& picture) {
  const std::size_t colors = opened.colors(), in = std::size_t(picture.channels), out = 3 + opened.alpha(),
                    width = std::size_t(picture.width);
  std::vector<float> row(width * in), color(width * colors), light(width * 3), result(width * out);
  const std::size_t rows = std::size_t(picture.height), before = row.size() * sizeof(float),
                    after = result.size() * sizeof(float);
  std::string grown(after > before ? after * rows : 0, '\0');
  // Where it does not grow it takes the same memory, row by row.
  std::string& samples = after > before ? grown : picture.samples;
  for (std::size_t y = 0; y < rows; ++y) {
    std::memcpy(row.data(), picture.samples.data() + y * before, before);
    for (std::size_t x = 0; x < width; ++x) {
      const float alpha = opened.alpha() && picture.straight == 0 ? row[x * in + colors] : 1.0f;
      for (std::size_t c = 0; c < colors; ++c)
        color[x * colors + c] = alpha > 0.0f ? row[x * in + c] / alpha : row[x * in + c];
    }
    opened.profile->toLinear(color.data(), width, light.data());
    for (std::size_t x = 0; x < width; ++x) {
      // Screens of whole numbers end where sRGB ends; light of floats need not.
      for (std::size_t c = 0; c < 3; ++c)
        result[x * out + c] = whole ? std::clamp(light[3 * x + c], 0.0f, 1.0f) : light[3 * x + c];
      if (opened.alpha()) result[x * out + 3] = row[x * in + colors];
    }
    std::memcpy(samples.data() + y * after, result.data(), after);
  }
  samples.resize(after * rows);
  if (after > before) picture.samples = std::move(grown);
  picture.channels = std::int32_t(out);
  picture.curve = Curve::linear;
  picture.straight = 1;
}

// What no profile describes: the light that each ink leaves of that which the others leave.
void mixInks(Picture& picture) {
  std::string rgb;
  rgb.reserve(picture.samples.size() / 4 * 3);
  for (std::size_t i = 0; i < picture.samples.size(); i += 4) {
    const auto left = [&](std::size_t c) { return 255 - static_cast<unsigned char>(picture.samples[i + c]); };
    for (std::size_t c = 0; c < 3; ++c) rgb += char((left(c) * left(3) + 127) / 255);
  }
  picture.samples = std::move(rgb);
  picture.channels = 3;
}

// Bytes that only pad each pixel to four are all zero, which as alpha would be a picture of nothing.
void dropPadding(const Opened& opened, Picture& picture) {
  if (picture.channels != 4 || picture.sample != Sample::byte ||
      saysAlpha(opened.file, opened.input->format_name()))
    return;
  picture.straight = 1;  // What nothing was said of is multiplied by nothing.
  for (std::size_t i = 3; i < picture.samples.size(); i += 4)
    if (picture.samples[i] != 0) return;
  for (std::size_t from = 0, to = 0; from < picture.samples.size(); from += 4, to += 3)
    std::memmove(&picture.samples[to], &picture.samples[from], 3);
  picture.samples.resize(picture.samples.size() / 4 * 3);
  picture.channels = 3;
}

void readInks(const Opened& opened, Picture& picture) {
  Inks inks = readInkJpeg(opened.file);
  if (inks.width != picture.width || inks.height != picture.height) throw Unreadable("is damaged");
  picture.samples.assign(reinterpret_cast<const char*>(inks.cmyk.data()), inks.cmyk.size());
  if (!opened.profile) return mixInks(picture);
  std::string floats(picture.samples.size() * sizeof(float), '\0');
  for (std::size_t i = 0; i < inks.cmyk.size(); ++i) {
    const float ink = float(inks.cmyk[i]) / 255.0f;
    std::memcpy(&floats[i * sizeof(float)], &ink, sizeof ink);
  }
  picture.samples = std::move(floats);
  picture.sample = Sample::real;
}

}  // namespace

Picture readPicture(const std::filesystem::path& file, Wanted wanted) {
  Opened opened = openPicture(file, wanted);
  const bool converts = opened.profile && !opened.profile->isSrgb();
  const auto stored = static_cast<TypeDesc::BASETYPE>(opened.spec.format.basetype);
  const bool whole = !opened.spec.format.is_floating_point();
  Picture picture;
  setCurve(opened.spec, picture);
  if (opened.profile && !converts) picture.curve = Curve::srgb;
  allowTimeFor(std::int64_t(opened.spec.width) * opened.spec.height);
  const Window window = shownOf(opened);
  picture.width = window.width;
  picture.height = window.height;
  picture.channels = std::int32_t(opened.layer.channels.size());
  picture.orientation = std::clamp(opened.spec.get_int_attribute("Orientation", 1), 1, 8);
  picture.sample = converts                     ? Sample::real
                   : stored == TypeDesc::UINT8  ? Sample::byte
                   : stored == TypeDesc::UINT16 ? Sample::word
                                                : Sample::real;
  if (opened.inks && opened.is("jpeg")) {
    picture.sample = Sample::byte;
    readInks(opened, picture);
  } else {
    picture.samples = samplesOf(opened, window,
                                picture.sample == Sample::byte   ? TypeDesc::UINT8
                                : picture.sample == Sample::word ? TypeDesc::UINT16
                                                                 : TypeDesc::FLOAT);
    // Asked for after reading: that is when a reader knows whether the hint could be followed.
    picture.straight =
        opened.is("bmp") || opened.input->spec().get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    dropPadding(opened, picture);
  }
  if (converts) useProfile(opened, whole, picture);
  if (wanted == Wanted::heights) addNoData(opened, picture);
  return picture;
}

std::string colorNote(const std::filesystem::path& file) {
  return openPicture(file, Wanted::colors).note;
}

}  // namespace fluidtex::foreign::here
