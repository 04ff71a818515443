#include "texture/frames/fresh_start.h"

#include "numerics/random.h"
#include "texture/labels/guidance.h"
#include "texture/labels/usage.h"
#include "texture/labels/ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr int kPlaces = 256;        // random places per disc
constexpr int kCompared = 64;       // of these, the least used
constexpr int kUsageCells = 12;     // along the shorter side of the exemplar
constexpr float kGuided = 4.0f;     // a guidance level off by 0.25 costs as much as a correlation of 1
constexpr std::size_t kStride = 3;  // every third vertex is compared

// A block of the exemplar.
struct Block {
  Vec2f center{0.0f};
  Way way = 0;
  Vec2f texelAt(const Vec2f& offset) const { return center + laid(way, offset); }
};

// Cost of a block for a disc: mean guidance cost minus correlation with the present picture. The least
// squared difference would always favour blocks of little contrast.
float unsuitability(const MeshView& view, const TexelImage& image, const Neighborhoods& blocks, std::size_t p,
                    const Block& block, const Values& value) {
  Float8 a{}, b{}, aa{}, bb{}, ab{};
  float count = 0.0f, unfit = 0.0f;
  for (std::size_t i = blocks.first[p]; i < blocks.first[p + 1]; i += kStride) {
    const std::uint32_t v = blocks.vertex[i];
    const Vec2f texel = block.texelAt(blocks.offset[i]);
    const Float8 x = image.sample(texel), y = value[v];
    a += x, b += y, aa += x * x, bb += y * y, ab += x * y, count += 1.0f;
    unfit += guidanceCost(image, view.mesh, image.brought(texel), v);
  }
  const float product = sum8(aa - a * a / count) * sum8(bb - b * b / count);
  const float correlation = sum8(ab - a * b / count) / std::sqrt(std::max(product, 1e-12f));
  return kGuided * unfit / count - correlation;
}

}  // namespace

void startAfresh(const MeshView& view, const TexelImage& image, const std::vector<Disc>& discs, double radius,
                 const Values& value, std::uint64_t seed, Labels& labels) {
  std::vector<std::uint32_t> centers;
  const auto reach = float(kDiscShare * radius);
  std::vector<std::uint32_t> owner(labels.size(), kNone);  // index into `centers`
  for (const Disc& disc : discs) {
    for (const std::uint32_t v : disc.members) owner[v] = std::uint32_t(centers.size());
    centers.push_back(disc.center);
  }
  if (centers.empty()) return;

  Usage usage(image, std::max(8, std::min(image.width, image.height) / kUsageCells), labels.size(),
              demandOn(image, view.mesh));
  for (const Label& label : labels) usage.add(label.texel, 1.0f);
  const Neighborhoods blocks = buildNeighborhoods(view, 2 * std::max(1, int(std::ceil(reach))) + 1, centers);

  std::vector<Block> chosen(centers.size());
  tbb::parallel_for(std::size_t(0), centers.size(), [&](std::size_t p) {
    std::array<std::pair<float, Block>, kPlaces> places;
    const std::uint64_t key = randomBits(seed, centers[p]);
    for (std::uint64_t i = 0; i < kPlaces; ++i) {
      const Vec2f place = image.centerFor({float(randomUnit(key, 2 * i)) * float(image.width - 1),
                                           float(randomUnit(key, 2 * i + 1)) * float(image.height - 1)},
                                          reach);
      places[i] = {usage.at(place), {place, wayAt(image.ways, int(i) % countOf(image.ways))}};
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    chosen[p] = places.front().second;
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < kCompared; ++i) {
      const float d = unsuitability(view, image, blocks, p, places[std::size_t(i)].second, value);
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
      labels[v] =
          unstretched(image.brought(chosen[p].texelAt(l)), seenFrom(layOf(chosen[p].way), blocks.turn[i]));
      placed[v] = 1;
    }
  handOn(image, view, wanted, std::move(placed), labels);
}

}  // namespace fluidtex::texture
