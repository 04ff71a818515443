#include "texture/renewal.h"

#include "texture/complex.h"
#include "texture/random.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kSeamWeight = 1.5f;
constexpr float kLostStretch = 4.0f;
constexpr float kLowTrust = 0.3f;
constexpr float kSameTexel = 0.7f;  // a proposal this near to the carried texel says the same
// A seam is bad where its badness, averaged over a few rings, exceeds that of texture stretched
// kSeamTolerance times as much (in the logarithm) as is kept.
constexpr float kSeamTolerance = 1.0f;
constexpr int kSeamBlurSweeps = 4;

template <typename Body>
void forEachVertex(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 512),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t v = range.begin(); v != range.end(); ++v) body(std::uint32_t(v));
                    });
}

bool lost(const TexelImage& image, const Label& label, float trust) {
  if (trust < kLowTrust) return true;
  if (image.toroidal) return false;
  return (label.texel - image.brought(label.texel)).lengthSqr() > 0.25f;
}

float stretchBadness(const TexelImage& image, const Label& label, float trust) {
  const float amount = std::log(stretch(label));
  return lost(image, label, trust) ? std::max(amount, std::log(kLostStretch)) : amount;
}

std::vector<float> seamBadness(const MeshView& view, const TexelImage& image, const Labels& labels,
                               const Float8& channelWeight) {
  std::vector<float> result = seamContrast(view, image, labels, channelWeight);
  const float scale = kSeamWeight / std::max(randomDifference(image, channelWeight), 1e-6f);
  for (float& value : result) value *= scale;
  return result;
}

}  // namespace

std::vector<float> badness(const MeshView& view, const TexelImage& image, const Labels& labels,
                           const std::vector<float>& trust, const Float8& channelWeight) {
  std::vector<float> result = seamBadness(view, image, labels, channelWeight);
  forEachVertex(result.size(),
                [&](std::uint32_t v) { result[v] += stretchBadness(image, labels[v], trust[v]); });
  return result;
}

std::vector<std::uint8_t> worthRenewing(const MeshView& view, const TexelImage& image, const Labels& labels,
                                        const std::vector<float>& trust, const Float8& channelWeight,
                                        double keepStretch, std::uint64_t seed) {
  std::vector<float> seams = seamBadness(view, image, labels, channelWeight), blurred(seams.size());
  for (int sweep = 0; sweep < kSeamBlurSweeps; ++sweep) {
    forEachVertex(seams.size(), [&](std::uint32_t v) {
      float sum = seams[v];
      const auto around = view.graph.around(v);
      for (const std::uint32_t u : around) sum += seams[u];
      blurred[v] = sum / float(around.size() + 1);
    });
    seams.swap(blurred);
  }
  const auto kept = float(std::log(keepStretch));
  std::vector<std::uint8_t> result(labels.size());
  forEachVertex(labels.size(), [&](std::uint32_t v) {
    constexpr float kCell = 12.0f;  // texels
    const auto column = std::uint64_t(std::int64_t(std::floor(labels[v].texel[0] / kCell)));
    const auto row = std::uint64_t(std::int64_t(std::floor(labels[v].texel[1] / kCell)));
    const auto jitter = float(0.8 + 0.4 * randomUnit(seed, randomBits(column, row)));
    result[v] =
        stretchBadness(image, labels[v], trust[v]) > kept * jitter || seams[v] > kSeamTolerance * kept;
  });
  return result;
}

std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::uint8_t> next = mask;
    forEachVertex(mask.size(), [&](std::uint32_t v) {
      for (const std::uint32_t u : graph.around(v))
        if (mask[u]) next[v] = 1;
    });
    mask.swap(next);
  }
  return mask;
}

Labels settle(const MeshView& view, const TexelImage& image, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, const Float8& channelWeight,
              std::vector<std::uint8_t>& renewed) {
  const std::size_t count = carried.size();
  Labels result = carried;
  renewed.assign(count, 0);
  forEachVertex(count, [&](std::uint32_t v) {
    const Vec2f difference = proposed[v].texel - carried[v].texel;
    if (difference.lengthSqr() <= kSameTexel * kSameTexel &&
        stretch(carried[v]) <= stretch(proposed[v]) + 0.05f)
      return;
    renewed[v] = 1;
    result[v] = proposed[v];
  });

  const std::vector<float> before = badness(view, image, carried, trust, channelWeight);
  const std::vector<float> trusted(count, 1.0f);  // what is proposed does not depend on what was carried
  const std::vector<float> after = badness(view, image, result, trusted, channelWeight);
  std::vector<std::uint8_t> seen(count, 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < count; ++start) {
    if (!renewed[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    double change = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      change += double(after[piece[i]]) - double(before[piece[i]]);
      for (const std::uint32_t u : view.graph.around(piece[i])) {
        if (!renewed[u]) continue;
        if (!seen[u]) seen[u] = 1, piece.push_back(u);
      }
    }
    if (change < -0.02 * double(piece.size())) continue;
    for (const std::uint32_t v : piece) {
      renewed[v] = 0;
      result[v] = carried[v];
    }
  }
  return result;
}

}  // namespace fluidtex::texture
