#include "texture/labels/guidance.h"

#include "texture/loops/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kCostOfLevel = 2.0f;  // a level off by 0.5 costs as much as a stretch by e
constexpr int kCell = 8;              // texels
constexpr int kLevels = 16;           // bins of the levels
constexpr double kHardlyAny = 1e-3;   // share of the exemplar below which a level counts as absent

using Shares = std::array<double, kLevels>;

int levelOf(float guidance) {
  return int(std::lround(std::clamp(guidance, 0.0f, 1.0f) * float(kLevels - 1)));
}

// Wanted share of each level; levels absent from the exemplar count for the nearest present one.
Shares wantedShares(const SurfaceMesh& mesh, const Shares& available) {
  Shares wanted{};
  for (const float guidance : mesh.guidance) wanted[std::size_t(levelOf(guidance))] += 1.0;
  Shares result{};
  for (int level = 0; level < kLevels; ++level) {
    int nearest = -1;
    for (int other = 0; other < kLevels; ++other)
      if (available[std::size_t(other)] > kHardlyAny &&
          (nearest < 0 || std::abs(other - level) < std::abs(nearest - level)))
        nearest = other;
    result[std::size_t(nearest)] += wanted[std::size_t(level)] / double(mesh.guidance.size());
  }
  return result;
}

// 3 x 3 box filter.
void blur(bool toroidal, Demand& demand) {
  const auto continued = [&](int i, int n) { return toroidal ? (i + n) % n : std::clamp(i, 0, n - 1); };
  const std::vector<float> sharp = demand.share;
  for (int j = 0; j < demand.rows; ++j)
    for (int i = 0; i < demand.columns; ++i) {
      float sum = 0.0f;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di)
          sum += sharp[std::size_t(continued(j + dj, demand.rows) * demand.columns +
                                   continued(i + di, demand.columns))];
      demand.share[std::size_t(j * demand.columns + i)] = sum / 9.0f;
    }
}

}  // namespace

bool isGuided(const TexelImage& image, const SurfaceMesh& mesh) {
  return image.guide >= 0 && !mesh.guidance.empty();
}

void holdGuidance(const TexelImage& image, const SurfaceMesh& mesh, Values& values) {
  if (!isGuided(image, mesh)) return;
  const float scale = std::sqrt(image.guidanceWeight);
  forEachIndex(values.size(), [&](std::uint32_t v) { values[v][image.guide] = scale * mesh.guidance[v]; });
}

float guidanceCost(const TexelImage& image, const SurfaceMesh& mesh, const Vec2f& texel, std::uint32_t v) {
  if (!isGuided(image, mesh) || !(image.guidanceWeight > 0.0f)) return 0.0f;
  const float there = image.sample(texel)[image.guide] / std::sqrt(image.guidanceWeight);
  const float off = std::abs(there - mesh.guidance[v]);
  return kCostOfLevel * image.guidanceWeight * std::max(0.0f, off - kFittingLevel);
}

float Demand::at(float x, float y) const {
  const int i = std::clamp(int(x / float(kCell)), 0, columns - 1);
  const int j = std::clamp(int(y / float(kCell)), 0, rows - 1);
  return share[std::size_t(j * columns + i)];
}

Demand demandOn(const TexelImage& image, const SurfaceMesh& mesh) {
  if (!isGuided(image, mesh) || !(image.guidanceWeight > 0.0f)) return {};
  const float scale = 1.0f / std::sqrt(image.guidanceWeight);
  Demand demand{(image.width + kCell - 1) / kCell, (image.height + kCell - 1) / kCell, {}};
  // Histograms of the exemplar's levels by cell; integer counts do not depend on the order of summation.
  const std::size_t cells = std::size_t(demand.columns) * std::size_t(demand.rows);
  std::vector<std::array<std::uint32_t, kLevels>> counts(cells);
  forEachIndex(cells, [&](std::uint32_t cell) {
    const int x0 = int(cell) % demand.columns * kCell, y0 = int(cell) / demand.columns * kCell;
    for (int y = y0; y < std::min(y0 + kCell, image.height); ++y)
      for (int x = x0; x < std::min(x0 + kCell, image.width); ++x)
        ++counts[cell]
                [std::size_t(levelOf(scale * image.at(image.nearest(float(x), float(y)))[image.guide]))];
  });
  Shares available{};
  for (const auto& count : counts)
    for (std::size_t level = 0; level < kLevels; ++level)
      available[level] += double(count[level]) / (double(image.width) * image.height);
  Shares asked = wantedShares(mesh, available);
  for (std::size_t level = 0; level < kLevels; ++level)
    asked[level] = available[level] > kHardlyAny ? asked[level] / available[level] : 0.0;
  demand.share.resize(cells);
  forEachIndex(cells, [&](std::uint32_t cell) {
    double sum = 0.0, texels = 0.0;
    for (std::size_t level = 0; level < kLevels; ++level) {
      sum += asked[level] * counts[cell][level];
      texels += counts[cell][level];
    }
    demand.share[cell] = float(sum / texels);
  });
  blur(image.toroidal, demand);
  return demand;
}

}  // namespace fluidtex::texture
