#include "texture/transition/join_exemplars.h"

#include <algorithm>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// Rows from the middle.
Image cropped(const Image& image, int height) {
  const std::size_t row = std::size_t(image.width) * std::size_t(image.channels);
  const auto first = image.data.begin() + std::ptrdiff_t(row * std::size_t((image.height - height) / 2));
  return {image.width, height, image.channels, {first, first + std::ptrdiff_t(row * std::size_t(height))}};
}

}  // namespace

JoinedExemplars joinExemplars(const std::vector<Image>& pictures, const TransitionOptions& options) {
  if (pictures.size() < 2) throw std::invalid_argument("joinExemplars: two pictures or more are needed");
  int height = pictures[0].height;
  for (const Image& picture : pictures) height = std::min(height, picture.height);
  std::vector<Image> parts;
  for (const Image& picture : pictures) parts.push_back(cropped(picture, height));

  JoinedExemplars joined{0, height, {}, {}};
  std::vector<int> first;  // column of each part
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const int transitions = k == 0 || k + 1 == parts.size() ? 1 : 2;
    if (parts[k].width < transitions * options.width)
      throw std::invalid_argument("joinExemplars: a picture is narrower than its transitions");
    first.push_back(joined.width);
    joined.width += parts[k].width - (k + 1 == parts.size() ? 0 : options.width);
  }
  joined.source.resize(std::size_t(joined.width) * std::size_t(height));
  joined.guidance = {joined.width, height, 1, std::vector<float>(joined.source.size())};
  const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(joined.width) + std::size_t(x); };
  const float step = 1.0f / float(parts.size() - 1);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const int cut = (pictures[k].height - height) / 2;
    for (int y = 0; y < height; ++y)
      for (int x = k == 0 ? 0 : options.width; x < parts[k].width; ++x) {
        joined.source[at(first[k] + x, y)] = {std::int32_t(k), x, y + cut};
        joined.guidance.data[at(first[k] + x, y)] = step * float(k);
      }
  }
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    TransitionOptions own = options;
    own.seed = options.seed + k;
    const std::vector<std::uint8_t> fromNext = transition(parts[k], parts[k + 1], own);
    const int column = parts[k].width - options.width;
    const int cut = (pictures[k].height - height) / 2, cutNext = (pictures[k + 1].height - height) / 2;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < options.width; ++x) {
        const bool next = fromNext[std::size_t(y) * std::size_t(options.width) + std::size_t(x)];
        joined.source[at(first[k + 1] + x, y)] = next ? PixelOrigin{std::int32_t(k + 1), x, y + cutNext}
                                                      : PixelOrigin{std::int32_t(k), column + x, y + cut};
        joined.guidance.data[at(first[k + 1] + x, y)] =
            step * (float(k) + (float(x) + 0.5f) / float(options.width));
      }
  }
  return joined;
}

Image joinedMap(const JoinedExemplars& joined, const std::vector<Image>& maps) {
  Image result{joined.width, joined.height, maps.empty() ? 0 : maps[0].channels, {}};
  result.data.reserve(joined.source.size() * std::size_t(result.channels));
  for (const PixelOrigin& source : joined.source) {
    const bool there = std::size_t(source.picture) < maps.size();
    if (!there || maps[std::size_t(source.picture)].channels != result.channels ||
        source.x >= maps[std::size_t(source.picture)].width ||
        source.y >= maps[std::size_t(source.picture)].height)
      throw std::invalid_argument(
          "joinedMap: every exemplar needs a map of its size, all with equal channels");
    const float* pixel = maps[std::size_t(source.picture)].at(source.x, source.y);
    result.data.insert(result.data.end(), pixel, pixel + result.channels);
  }
  return result;
}

}  // namespace fluidtex::texture
