#include "texture/measure.h"

#include "texture/measure_patches.h"
#include "texture/measure_repeats.h"
#include "texture/measure_tiles.h"

#include <algorithm>
#include <map>

namespace fluidtex::texture {
namespace {

constexpr int kEnoughTiles = 24;  // of a size; fewer, and smaller ones are tried
constexpr int kSmallest = 17;     // texels across
constexpr int kFewest = 4;
constexpr int kGap = 2;  // texels on both sides of the line between an exemplar's halves

Image cut(const Image& image, int x0, int y0, int width, int height) {
  Image part{width, height, image.channels, {}};
  for (int y = 0; y < height; ++y)
    part.data.insert(part.data.end(), image.at(x0, y0 + y), image.at(x0, y0 + y) + width * image.channels);
  return part;
}

// Left and right, top and bottom.
std::vector<std::pair<Image, Image>> halvesOf(const Image& image) {
  const int w = image.width, h = image.height;
  const int left = w / 2 - kGap, right = w / 2 + kGap, top = h / 2 - kGap, bottom = h / 2 + kGap;
  return {{cut(image, 0, 0, left, h), cut(image, right, 0, w - right, h)},
          {cut(image, 0, 0, w, top), cut(image, 0, bottom, w, h - bottom)}};
}

// Of the lightness: mean square of forward differences along both axes.
double gradientEnergy(const Stack& stack) {
  double sum = 0.0;
  for (int t = 0; t < stack.count; ++t)
    for (int y = 0; y + 1 < stack.height; ++y)
      for (int x = 0; x + 1 < stack.width; ++x) {
        const double here = *stack.at(t, y, x), right = *stack.at(t, y, x + 1),
                     below = *stack.at(t, y + 1, x);
        sum += (right - here) * (right - here) + (below - here) * (below - here);
      }
  return sum / (double(stack.count) * (stack.height - 1) * (stack.width - 1));
}

// The exemplar on tiles of one size.
struct Reference {
  PatchJudge judge;
  std::vector<PatchDistances> own;
  double energy = 0.0, parts = 0.0;
};

}  // namespace

struct LikenessJudge::Internals {
  Image picture;
  MeasureOptions options;
  Dice dice;
  CoverageMap coverage;
  std::map<int, Reference> references;

  Internals(const Image& color, const MeasureOptions& asked)
      : picture(encodedPicture(color)), options(asked), dice(asked.seed), coverage(picture, dice) {}

  const Reference& reference(const std::vector<Tile>& tiles, int size) {
    if (const auto found = references.find(size); found != references.end()) return found->second;
    const auto laid = [&](const Image& image) {
      return exemplarTiles(image, tiles, size, options.tiles, dice);
    };
    const Stack whole = laid(picture);
    Reference made{PatchJudge(pyramidOf(whole), options.patches, dice),
                   {},
                   gradientEnergy(whole),
                   coverage.effectiveParts(whole, dice)};
    for (const auto& [a, b] : halvesOf(picture)) {
      const PatchJudge half(pyramidOf(laid(a)), options.patches, dice);
      made.own.push_back(half.distances(pyramidOf(laid(b)), dice));
    }
    return references.emplace(size, std::move(made)).first->second;
  }
};

LikenessJudge::LikenessJudge(const Image& color, const MeasureOptions& options)
    : m_internals(std::make_unique<Internals>(color, options)) {}

LikenessJudge::~LikenessJudge() = default;

std::optional<Likeness> LikenessJudge::operator()(const TexturedSurface& surface) {
  if (surface.empty()) return std::nullopt;
  Internals& in = *m_internals;
  const TileGround ground(surface);
  Likeness result;
  std::vector<Tile> tiles;
  for (result.tile = in.options.tile;;
       result.tile = std::max(kSmallest, int(result.tile * 0.72) / 2 * 2 + 1)) {
    tiles = flatTiles(ground, result.tile, in.options.tiles, in.dice);
    if (int(tiles.size()) >= std::min(kEnoughTiles, in.options.tiles) || result.tile <= kSmallest) break;
  }
  result.tiles = int(tiles.size());
  if (result.tiles < kFewest) return std::nullopt;
  const Reference& reference = in.reference(tiles, result.tile);
  const Stack shown = colorTiles(surface, tiles, result.tile, in.picture.channels);
  result.likeness = patchRatio(reference.judge.distances(pyramidOf(shown), in.dice), reference.own);
  result.sharpness = gradientEnergy(shown) / std::max(reference.energy, 1e-12);
  result.coverage = in.coverage.effectiveParts(shown, in.dice) / std::max(reference.parts, 1e-12);
  if (in.options.repeats) result.repeats = repeatsOf(ground, in.picture, in.dice);
  return result;
}

}  // namespace fluidtex::texture
