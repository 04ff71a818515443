#include "texture/exemplar/exemplar.h"

#include "texture/exemplar/channels.h"
#include "texture/exemplar/load_map.h"
#include "texture/exemplar/matched_maps.h"
#include "texture/exemplar/read_image.h"
#include "texture/exemplar/srgb.h"
#include "texture/exemplar/texel_image.h"
#include "texture/exemplar/window_size.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Encoded premultiplied colours of a level, from linear premultiplied RGBA.
Image encodedColors(const Image& premultiplied, int channels) {
  Image result{premultiplied.width, premultiplied.height, channels, {}};
  result.data.resize(std::size_t(result.width) * std::size_t(result.height) * std::size_t(channels));
  tbb::parallel_for(0, result.height, [&](int y) {
    for (int x = 0; x < result.width; ++x) {
      const float* in = premultiplied.at(x, y);
      float* out = result.at(x, y);
      for (int c = 0; c < 3; ++c) out[c] = encodeSrgb(in[c]);
      if (channels > 3) out[3] = in[3];
    }
  });
  return result;
}

// `image` with the channels of another one appended, scaled.
Image withChannels(const Image& image, const Image& more, float scale) {
  Image result{image.width, image.height, image.channels + more.channels, {}};
  result.data.resize(image.data.size() + more.data.size());
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      float* end = std::copy_n(image.at(x, y), image.channels, result.at(x, y));
      std::transform(more.at(x, y), more.at(x, y) + more.channels, end, [&](float v) { return v * scale; });
    }
  });
  return result;
}

std::string sizeOf(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void check(const Image& color, bool toroidal, const SynthesisOptions& synthesis, const std::string& name) {
  if (color.channels != 4 || color.width < 1 || color.height < 1 ||
      color.data.size() != std::size_t(color.width) * std::size_t(color.height) * 4)
    throw std::invalid_argument("makeExemplar: the image must be RGBA and hold all its pixels");
  int window = 1;
  for (const int w : synthesis.windows) window = std::max(window, w);
  if (std::min(color.width, color.height) < window)
    throw ExemplarError(name + " is too small: it has " + sizeOf(color) +
                        " pixels, and the largest window needs " + std::to_string(window) + " x " +
                        std::to_string(window) + ".");
  if (fittingWindow(color, toroidal, kSmallestWindow) < kSmallestWindow)
    throw ExemplarError(name + " is too small: it has " + sizeOf(color) +
                        " pixels, and an image whose edges do not meet needs at least 5 x 5.");
  bool visible = false;
  for (std::size_t i = 0; i < color.data.size(); ++i) {
    if (!std::isfinite(color.data[i]))
      throw ExemplarError(name + " holds values that are not finite numbers.");
    visible = visible || (i % 4 == 3 && color.data[i] > 0.0f);
  }
  if (!visible) throw ExemplarError(name + " is fully transparent, so there is no texture to take from it.");
}

// Of the pictures of a sequence besides the first: how many are matched, and their weight together.
constexpr std::size_t kSequenceMatched = 16;
constexpr double kSequenceWeight = 2.0;

bool anyMatched(const std::map<std::string, ExemplarMap>& maps) {
  return std::any_of(maps.begin(), maps.end(), [](const auto& map) { return map.second.weight > 0.0f; });
}

Image premultipliedColors(Image color) {
  for (std::size_t i = 0; i < color.data.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) color.data[i + c] *= color.data[i + 3];
  return color;
}

Image halved(Image image, const ExemplarOptions& options) {
  for (int n = 0; n < options.halvings; ++n) image = halve(image, options.toroidal);
  return image;
}

// Channels left for maps by colours, guidance and the two feature channels.
int lanesForMaps(const Exemplar& exemplar, const SynthesisOptions& synthesis) {
  return kMaxChannels - exemplar.colorChannels - exemplar.guided - (synthesis.featureWeight > 0.0) -
         (synthesis.gradientWeight > 0.0);
}

// What is matched beside the colours.
struct MatchedInputs {
  Image guidance;  // one channel, or empty
  std::map<std::string, ExemplarMap> maps;
};

// Fills match and its description of the maps.
void makeMatch(Exemplar& exemplar, MatchedInputs inputs, const SynthesisOptions& synthesis, int levels) {
  const bool toroidal = exemplar.toroidal;
  Image premultiplied = premultipliedColors(exemplar.color);
  Image encoded = encodedColors(premultiplied, exemplar.colorChannels);
  const Image luminance = featureLuminance(encoded);

  // Computed at full size and reduced with the colours, each in its own space.
  std::vector<std::pair<Image, float>> channels;
  if (!inputs.guidance.data.empty())
    channels.emplace_back(std::move(inputs.guidance), float(std::sqrt(synthesis.guidanceWeight)));
  if (anyMatched(inputs.maps)) {
    MatchedMaps matched =
        matchedMaps(inputs.maps, exemplar.color, encoded, toroidal, lanesForMaps(exemplar, synthesis));
    exemplar.mapChannels = matched.image.channels;
    exemplar.mapShare = matched.share;
    if (exemplar.mapChannels > 0) channels.emplace_back(std::move(matched.image), 1.0f);
  }
  if (synthesis.featureWeight > 0.0)
    channels.emplace_back(featureDistance(luminance, toroidal), float(std::sqrt(synthesis.featureWeight)));
  if (synthesis.gradientWeight > 0.0)
    channels.emplace_back(gradientEnergy(luminance, toroidal), float(std::sqrt(synthesis.gradientWeight)));

  for (int level = 0; level < levels; ++level) {
    if (level > 0) {
      premultiplied = halve(premultiplied, toroidal);
      for (auto& channel : channels) channel.first = halve(channel.first, toroidal);
    }
    Image match = level == 0 ? encoded : encodedColors(premultiplied, exemplar.colorChannels);
    for (const auto& [channel, scale] : channels) match = withChannels(match, channel, scale);
    exemplar.match.push_back(std::move(match));
  }
}

// File name that hashes all that makeMatch() depends on.
std::string nameOfMatch(const Exemplar& exemplar, const MatchedInputs& inputs,
                        const SynthesisOptions& synthesis, int levels) {
  const auto bits = [](double value) { return std::bit_cast<std::int64_t>(value); };
  std::vector<std::int64_t> settings{exemplar.color.width,
                                     exemplar.color.height,
                                     exemplar.colorChannels,
                                     exemplar.toroidal,
                                     levels,
                                     bits(synthesis.featureWeight),
                                     bits(synthesis.gradientWeight),
                                     bits(synthesis.guidanceWeight)};
  std::vector<std::span<const float>> data{exemplar.color.data, inputs.guidance.data};
  for (const auto& [name, map] : inputs.maps) {
    if (!(map.weight > 0.0f)) continue;
    for (const int size : {map.image.width, map.image.height, map.image.channels}) settings.push_back(size);
    settings.push_back(bits(map.weight));
    data.emplace_back(map.image.data);
  }
  return keptName(".match", settings, data);
}

// makeMatch(), or its cached result.
void keptOrMadeMatch(Exemplar& exemplar, MatchedInputs inputs, const SynthesisOptions& synthesis, int levels,
                     const CacheFolder& cache) {
  if (cache.path.empty()) return makeMatch(exemplar, std::move(inputs), synthesis, levels);
  const auto eachPart = [](auto& result, const auto& visit) {
    visit(result.mapChannels), visit(result.mapShare);
    for (auto& image : result.match)
      visit(image.width), visit(image.height), visit(image.channels), visit(image.data);
  };
  const std::string name = nameOfMatch(exemplar, inputs, synthesis, levels);
  if (const auto kept = readKept(cache, name)) {
    exemplar.match.resize(std::size_t(levels));
    const char* at = kept->data.get();
    return eachPart(exemplar, ByteReader{at});
  }
  makeMatch(exemplar, std::move(inputs), synthesis, levels);
  std::vector<char> bytes;
  eachPart(exemplar, ByteWriter{bytes});
  writeKept(cache, name, std::move(bytes));
}

struct Pictures {
  std::string name;  // in messages
  Image color;
  bool toroidal = false;
  Image guidance{};  // empty: unguided
  std::map<std::string, ExemplarMap> maps{};
  std::map<std::string, ExemplarMap> sequence{};  // further pictures, matched but not looked up
};

Exemplar prepare(Pictures pictures, const SynthesisOptions& synthesis, int levels, const CacheFolder& cache) {
  Image& color = pictures.color;
  check(color, pictures.toroidal, synthesis, pictures.name);
  Exemplar exemplar;
  exemplar.toroidal = pictures.toroidal;
  float least = color.data[3], most = color.data[3];
  for (std::size_t i = 3; i < color.data.size(); i += 4)
    least = std::min(least, color.data[i]), most = std::max(most, color.data[i]);
  exemplar.colorChannels = least < most ? 4 : 3;
  exemplar.guided = !pictures.guidance.data.empty();
  exemplar.guidanceWeight = float(synthesis.guidanceWeight);
  exemplar.color = std::move(color);
  exemplar.maps = std::move(pictures.maps);
  // Transported colours have no maps beside them.
  if (synthesis.method != Method::coordinates)
    for (auto& [own, map] : exemplar.maps) map.weight = 0.0f;
  MatchedInputs inputs{std::move(pictures.guidance), exemplar.maps};
  inputs.maps.merge(pictures.sequence);
  keptOrMadeMatch(exemplar, std::move(inputs), synthesis, std::max(levels, 1), cache);
  return exemplar;
}

// The other pictures of a sequence as maps of colours, encoded and premultiplied as colours are matched.
std::map<std::string, ExemplarMap> sequenceMaps(const AnimationOptions& animation, const Image& color) {
  std::map<std::string, ExemplarMap> maps;
  const std::size_t others = animation.files.size() < 2 ? 0 : animation.files.size() - 1;
  const std::size_t matched = std::min<std::size_t>(others, kSequenceMatched);
  std::size_t next = 0;  // of the matched ones
  for (std::size_t n = 1; n <= others; ++n) {
    // All are read, so that what is wrong with one is told before anything is made.
    Image picture = readImage(animation.files[n]);
    const std::string name = animation.files[n].string();
    if (picture.width != color.width || picture.height != color.height)
      throw ExemplarError(name + " has " + sizeOf(picture) + " pixels, and the first of its sequence " +
                          sizeOf(color) + "; all must be of one size.");
    if (n != 1 + next * others / matched) continue;
    ++next;
    maps["picture " + std::to_string(n)] = {encodedColors(premultipliedColors(std::move(picture)), 3),
                                            MapHolds::values, float(kSequenceWeight / double(matched))};
  }
  return maps;
}

}  // namespace

Exemplar makeExemplar(Image color, bool toroidal, const SynthesisOptions& synthesis, int levels,
                      Image guidance, const CacheFolder& cache, std::map<std::string, ExemplarMap> maps) {
  return prepare({.name = "the image",
                  .color = std::move(color),
                  .toroidal = toroidal,
                  .guidance = std::move(guidance),
                  .maps = std::move(maps)},
                 synthesis, levels, cache);
}

Image exemplarPicture(const ExemplarOptions& options) {
  Image color = readImage(options.file);
  if (options.halvings == 0) return color;
  color = halved(premultipliedColors(std::move(color)), options);
  for (std::size_t i = 0; i < color.data.size(); i += 4) {
    const Vec4f pixel = straight(Vec4f(&color.data[i]));
    std::copy_n(pixel.asPointer(), 4, &color.data[i]);
  }
  return color;
}

Exemplar loadExemplar(const ExemplarOptions& options, const SynthesisOptions& synthesis, int levels,
                      const CacheFolder& cache, Image guidance) {
  Image color = exemplarPicture(options);
  if (!options.guidance.empty()) {
    guidance = halved(readMap(options.guidance, 1), options);
    if (guidance.width != color.width || guidance.height != color.height)
      throw ExemplarError(options.guidance.string() + " has " + sizeOf(guidance) +
                          " pixels, and its exemplar " + options.file.string() + " " + sizeOf(color) +
                          "; a guidance map must be of the same size.");
  }
  if (!guidance.data.empty() && (guidance.width != color.width || guidance.height != color.height))
    throw std::invalid_argument("loadExemplar: the guidance must be as large as the picture");
  std::map<std::string, ExemplarMap> maps;
  for (const MapOptions& map : options.maps) maps[map.name] = loadMap(map, color.width, options.toroidal);
  std::map<std::string, ExemplarMap> sequence = sequenceMaps(options.animation, color);
  return prepare({.name = options.file.string(),
                  .color = std::move(color),
                  .toroidal = options.toroidal,
                  .guidance = std::move(guidance),
                  .maps = std::move(maps),
                  .sequence = std::move(sequence)},
                 synthesis, levels, cache);
}

}  // namespace fluidtex::texture
