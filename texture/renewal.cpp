#include "texture/renewal.h"

#include "texture/complex.h"
#include "texture/fresh.h"
#include "texture/parallel.h"
#include "texture/random.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kSeamWeight = 0.75f;
constexpr float kLostStretch = 4.0f;
constexpr float kSameTexel = 0.7f;      // a proposal this near to the carried texel says the same
constexpr float kRestSeconds = 0.4f;    // ten frames of a film: as long as the eye needs to follow a patch
constexpr float kYoungPatience = 1.2f;  // new texture must be this much worse again before it is renewed
constexpr float kLeastGain = 0.05f;     // a piece is renewed if its badness falls by this on average
constexpr int kBlurSweeps = 8;          // badness is averaged over about this many edges' reach in all

bool lost(const TexelImage& image, const Label& label, float trust) {
  if (trust < kLowTrust) return true;
  if (image.toroidal) return false;
  return (label.texel - image.brought(label.texel)).lengthSqr() > 0.25f;
}

float stretchBadness(const TexelImage& image, const Label& label, float trust) {
  const float amount = std::log(stretch(label));
  return lost(image, label, trust) ? std::max(amount, std::log(kLostStretch)) : amount;
}

// Smooth noise in 0..1 over the exemplar: random values at the corners of a grid, interpolated.
float noiseAt(const Vec2f& texel, std::uint64_t seed) {
  constexpr float kCell = 24.0f;  // texels
  const float x = texel[0] / kCell, y = texel[1] / kCell;
  const float i = std::floor(x), j = std::floor(y);
  const auto corner = [&](int di, int dj) {
    return float(randomUnit(
        seed, randomBits(std::uint64_t(std::int64_t(i) + di), std::uint64_t(std::int64_t(j) + dj))));
  };
  const float above = corner(0, 0) + (x - i) * (corner(1, 0) - corner(0, 0));
  const float below = corner(0, 1) + (x - i) * (corner(1, 1) - corner(0, 1));
  return above + (y - j) * (below - above);
}

}  // namespace

std::vector<float> badness(const SeamModel& model, const Labels& labels, const std::vector<float>& trust) {
  std::vector<float> result = seamCosts(model, labels);
  forEachIndex(result.size(), [&](std::uint32_t v) {
    result[v] = kSeamWeight * result[v] + stretchBadness(model.image, labels[v], trust[v]);
  });
  return result;
}

std::vector<std::uint8_t> worthRenewing(const SeamModel& model, const Labels& labels,
                                        const std::vector<float>& trust, const std::vector<float>& age,
                                        double keepStretch, std::uint64_t seed) {
  std::vector<float> bad = badness(model, labels, trust), blurred(bad.size());
  for (int sweep = 0; sweep < kBlurSweeps; ++sweep) {
    forEachIndex(bad.size(), [&](std::uint32_t v) {
      float sum = bad[v];
      const auto around = model.view.graph.around(v);
      for (const std::uint32_t u : around) sum += bad[u];
      blurred[v] = sum / float(around.size() + 1);
    });
    bad.swap(blurred);
  }
  const auto kept = float(std::log(keepStretch));
  std::vector<std::uint8_t> result(labels.size());
  forEachIndex(labels.size(), [&](std::uint32_t v) {
    const float young = std::max(0.0f, 1.0f - age[v] / kRestSeconds);
    const float threshold = kept * (0.8f + 0.4f * noiseAt(labels[v].texel, seed));
    result[v] = bad[v] > threshold * (1.0f + kYoungPatience * young);
  });
  return result;
}

std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::uint8_t> next = mask;
    forEachIndex(mask.size(), [&](std::uint32_t v) {
      for (const std::uint32_t u : graph.around(v))
        if (mask[u]) next[v] = 1;
    });
    mask.swap(next);
  }
  return mask;
}

Labels settle(const SeamModel& model, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, std::vector<std::uint8_t>& renewed) {
  const std::size_t count = carried.size();
  Labels result = carried;
  renewed.assign(count, 0);
  forEachIndex(count, [&](std::uint32_t v) {
    const Vec2f difference = texelDifference(model.image, proposed[v].texel, carried[v].texel);
    if (difference.lengthSqr() <= kSameTexel * kSameTexel &&
        stretch(carried[v]) <= stretch(proposed[v]) + 0.05f)
      return;
    renewed[v] = 1;
    result[v] = proposed[v];
  });

  const std::vector<float> before = badness(model, carried, trust);
  const std::vector<float> trusted(count, 1.0f);  // what is proposed does not depend on what was carried
  const std::vector<float> after = badness(model, result, trusted);
  // What renewing a vertex changes: its own badness, and its share of that of neighbours that stay.
  const VertexGraph& graph = model.view.graph;
  std::vector<float> change(count, 0.0f);
  forEachIndex(count, [&](std::uint32_t v) {
    if (!renewed[v]) return;
    change[v] = after[v] - before[v];
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      if (renewed[u]) continue;
      const float rise =
          seamCost(model, result[v], carried[u], h) - seamCost(model, carried[v], carried[u], h);
      change[v] += kSeamWeight * rise / float(graph.around(u).size());
    }
  });
  std::vector<std::uint8_t> seen(count, 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t start = 0; start < count; ++start) {
    if (!renewed[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    double sum = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      sum += double(change[piece[i]]);
      for (const std::uint32_t u : graph.around(piece[i])) {
        if (!renewed[u]) continue;
        if (!seen[u]) seen[u] = 1, piece.push_back(u);
      }
    }
    if (sum < -double(kLeastGain) * double(piece.size())) continue;
    for (const std::uint32_t v : piece) {
      renewed[v] = 0;
      result[v] = carried[v];
    }
  }
  return result;
}

}  // namespace fluidtex::texture
