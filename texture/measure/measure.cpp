#include "texture/measure/measure.h"

#include "numerics/random.h"
#include "texture/measure/patches.h"
#include "texture/measure/repeats.h"
#include "texture/measure/spectrum.h"
#include "texture/measure/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace fluidtex::texture {
namespace {

constexpr int kEnoughTiles = 24;  // tiles of a size; with fewer, smaller ones are tried
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

// Mean squared forward differences of the lightness along both axes.
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

// The exemplar on a frame's tiles, repeated, since it matters which parts of it fall on the tiles.
constexpr int kTimes = 3;
struct Laid {
  std::optional<PatchJudge> judge;
  std::vector<PatchDistances> own;
  double energy = 0.0, parts = 0.0;
  std::vector<double> spectrum;
};
using Reference = std::array<Laid, kTimes>;

double meanOf(const Reference& reference, double Laid::*figure) {
  double sum = 0.0;
  for (const Laid& laid : reference) sum += laid.*figure / kTimes;
  return sum;
}

std::vector<double> meanSpectrum(const Reference& reference) {
  std::vector<double> mean(reference.front().spectrum.size(), 0.0);
  for (const Laid& laid : reference)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += laid.spectrum[k] / kTimes;
  return mean;
}

// Streams of the options' seed: for the exemplar, for a frame, and for each time the exemplar is laid.
constexpr std::uint64_t kOfExemplar = 0, kOfFrame = 1, kOfTimes = 2;

}  // namespace

// No state is kept between frames, random numbers included: a frame's measures are its own.
struct LikenessJudge::Internals {
  Image picture;
  MeasureOptions options;
  CoverageMap coverage;

  Internals(const Image& color, const MeasureOptions& asked)
      : picture(encodedPicture(color)), options(asked), coverage(coverageOf(picture, asked.seed)) {}

  static CoverageMap coverageOf(const Image& picture, std::uint64_t seed) {
    Dice dice(randomBits(seed, kOfExemplar));
    return CoverageMap(picture, dice);
  }

  Laid lay(const std::vector<Tile>& tiles, int size, Dice dice) const {
    const auto laid = [&](const Image& image) {
      return exemplarTiles(image, tiles, size, options.tiles, dice);
    };
    const Stack whole = laid(picture);
    Laid made;
    made.energy = gradientEnergy(whole);
    made.spectrum = radialSpectrum(whole);
    made.parts = coverage.effectiveParts(whole, dice);
    made.judge.emplace(pyramidOf(whole), options.patches, dice);
    for (const auto& [a, b] : halvesOf(picture)) {
      const PatchJudge half(pyramidOf(laid(a)), options.patches, dice);
      made.own.push_back(half.distances(pyramidOf(laid(b)), dice));
    }
    return made;
  }

  Reference reference(const std::vector<Tile>& tiles, int size) const {
    Reference made;
    tbb::parallel_for(std::size_t(0), made.size(), [&](std::size_t n) {
      made[n] = lay(tiles, size, Dice(randomBits(options.seed, kOfTimes + n)));
    });
    return made;
  }
};

LikenessJudge::LikenessJudge(const Image& color, const MeasureOptions& options)
    : m_internals(std::make_unique<Internals>(color, options)) {}

LikenessJudge::~LikenessJudge() = default;

std::optional<Likeness> LikenessJudge::operator()(const TexturedSurface& surface, bool repeats) const {
  if (surface.empty()) return std::nullopt;
  const Internals& in = *m_internals;
  Dice dice(randomBits(in.options.seed, kOfFrame));
  const TileGround ground(surface);
  Likeness result;
  std::vector<Tile> tiles;
  for (result.tile = in.options.tile;;
       result.tile = std::max(kSmallest, int(result.tile * 0.72) / 2 * 2 + 1)) {
    tiles = flatTiles(ground, result.tile, in.options.tiles, dice);
    if (int(tiles.size()) >= std::min(kEnoughTiles, in.options.tiles) || result.tile <= kSmallest) break;
  }
  result.tiles = int(tiles.size());
  if (result.tiles < kFewest) return std::nullopt;
  const Reference reference = in.reference(tiles, result.tile);
  const Stack shown = colorTiles(surface, tiles, result.tile, in.picture.channels);
  const std::vector<Stack> pyramid = pyramidOf(shown);
  for (const Laid& laid : reference)
    result.likeness += patchRatio(laid.judge->distances(pyramid, dice), laid.own) / kTimes;
  result.sharpness = gradientEnergy(shown) / std::max(meanOf(reference, &Laid::energy), 1e-12);
  result.spectrum = spectrumDistance(radialSpectrum(shown), meanSpectrum(reference));
  result.coverage =
      in.coverage.effectiveParts(shown, dice) / std::max(meanOf(reference, &Laid::parts), 1e-12);
  if (repeats) result.repeats = repeatsOf(ground, in.picture, dice);
  return result;
}

}  // namespace fluidtex::texture
