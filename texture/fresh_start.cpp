#include "texture/fresh_start.h"

#include "texture/guidance.h"
#include "texture/random.h"
#include "texture/usage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr int kPlaces = 96;         // drawn at random
constexpr int kCompared = 24;       // the least used of them
constexpr int kUsageCells = 12;     // along the exemplar's shorter side
constexpr std::size_t kStride = 3;  // every third vertex is compared
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// How differently a block with its middle at `center` looks from what is there.
float difference(const TexelImage& image, const Neighborhoods& blocks, std::size_t p, const Vec2f& center,
                 const Values& value) {
  float sum = 0.0f;
  for (std::size_t i = blocks.first[p]; i < blocks.first[p + 1]; i += kStride) {
    const Float8 d = image.sample(center + blocks.offset[i]) - value[blocks.vertex[i]];
    sum += sum8(d * d);
  }
  return sum;
}

}  // namespace

void startAfresh(const MeshView& view, const TexelImage& image, const std::vector<Disc>& discs, double radius,
                 const Values& value, std::uint64_t seed, Labels& labels) {
  std::vector<std::uint32_t> centers;
  const auto reach = float(kDiscShare * radius);
  const auto fits = [&](const Disc& disc) {
    float cost = 0.0f;
    for (const std::uint32_t v : disc.members) cost += guidanceCost(image, view.mesh, labels[v].texel, v);
    return cost <= kFreshGuidance * float(disc.members.size());
  };
  std::vector<std::uint32_t> owner(labels.size(), kNone);  // the place among `centers`
  for (const Disc& disc : discs) {
    if (disc.growth <= kFreshGrowth && fits(disc)) continue;
    for (const std::uint32_t v : disc.members) owner[v] = std::uint32_t(centers.size());
    centers.push_back(disc.center);
  }
  if (centers.empty()) return;

  Usage usage(image, std::max(8, std::min(image.width, image.height) / kUsageCells), labels.size(),
              demandOn(image, view.mesh));
  for (const Label& label : labels) usage.add(label.texel, 1.0f);
  const Neighborhoods blocks = buildNeighborhoods(view, 2 * std::max(1, int(std::ceil(reach))) + 1, centers);

  std::vector<Vec2f> chosen(centers.size());
  tbb::parallel_for(std::size_t(0), centers.size(), [&](std::size_t p) {
    std::array<std::pair<float, Vec2f>, kPlaces> places;
    for (std::uint64_t i = 0; i < kPlaces; ++i) {
      const std::uint64_t key = randomBits(seed, centers[p]);
      const Vec2f place = image.centerFor({float(randomUnit(key, 2 * i)) * float(image.width - 1),
                                           float(randomUnit(key, 2 * i + 1)) * float(image.height - 1)},
                                          reach);
      places[i] = {usage.at(place), place};
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < kCompared; ++i) {
      const float d = difference(image, blocks, p, places[std::size_t(i)].second, value);
      if (d < least) least = d, chosen[p] = places[std::size_t(i)].second;
    }
  });
  std::vector<std::uint8_t> wanted(labels.size(), 0), placed = wanted;
  for (std::size_t v = 0; v < labels.size(); ++v) wanted[v] = owner[v] != kNone;
  for (std::size_t p = 0; p < centers.size(); ++p)
    for (std::size_t i = blocks.first[p]; i < blocks.first[p + 1]; ++i) {
      const std::uint32_t v = blocks.vertex[i];
      const Vec2f& l = blocks.offset[i];
      if (owner[v] != p || l.lengthSqr() > reach * reach) continue;
      labels[v] = unstretched(image.brought(chosen[p] + l), blocks.turn[i]);
      placed[v] = 1;
    }
  handOn(image, view, wanted, std::move(placed), labels);
}

}  // namespace fluidtex::texture
