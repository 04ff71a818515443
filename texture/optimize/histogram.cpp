// Kopf, Fu, Cohen-Or, Deussen, Lischinski, Wong: Solid Texture Synthesis from 2D Exemplars (2007), sec. 4.3.
// There the histogram is updated after every voxel; here it is taken once an iteration, so that the result
// does not depend on the order of vertices.
#include "texture/optimize/histogram.h"

#include "texture/loops/parallel.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::texture {
namespace {

Bins binsOf(const HistogramTarget& target, const Float8& value) {
  const Float8 position = (value - target.low) * target.scale;
  Bins bins;
  for (int c = 0; c < kMaxChannels; ++c)
    bins[c] =
        std::uint8_t(std::max(0.0f, std::min(kHistogramBins - 0.5f, position[c])));  // also of no number
  return bins;
}

// Counted in chunks of fixed size; integer sums do not depend on the number of threads.
template <typename BinsAt>
Histogram shares(std::size_t count, int channels, const BinsAt& binsAt) {
  constexpr std::size_t kChunk = 4096;
  using Counts = std::array<std::array<std::uint32_t, kHistogramBins>, kMaxChannels>;
  std::vector<Counts> partial((count + kChunk - 1) / kChunk, Counts{});
  tbb::parallel_for(std::size_t(0), partial.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const Bins bins = binsAt(i);
      for (int c = 0; c < channels; ++c) ++partial[chunk][c][bins[c]];
    }
  });
  Histogram result;
  for (int c = 0; c < channels; ++c) {
    for (int b = 0; b < kHistogramBins; ++b) {
      std::size_t sum = 0;
      for (const Counts& counts : partial) sum += counts[c][b];
      result.share[c][b] = float(double(sum) / double(std::max<std::size_t>(count, 1)));
    }
  }
  return result;
}

}  // namespace

HistogramTarget makeHistogramTarget(const TexelImage& image) {
  HistogramTarget target;
  struct Range {
    Float8 low, high;
    void take(const Float8& least, const Float8& most) {
      low = least < low ? least : low;
      high = most > high ? most : high;
    }
  };
  const Range first{image.at(0), image.at(0)};
  const auto [low, high] = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, image.data.size(), 4096), first,
      [&](const tbb::blocked_range<std::size_t>& range, Range result) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const Float8 texel = image.at(i);
          result.take(texel, texel);
        }
        return result;
      },
      [](Range a, const Range& b) {
        a.take(b.low, b.high);
        return a;
      });
  target.low = low;
  for (int c = 0; c < kMaxChannels; ++c)
    target.scale[c] = high[c] > low[c] ? float(kHistogramBins) / (high[c] - low[c]) : 0.0f;
  const auto variance = [&](int c) {
    Float8 only{};
    only[c] = 1.0f;
    const float difference = randomDifference(image, only);
    return 0.5f * difference * difference;
  };
  target.counts.fill(1.0f);
  for (int c = image.firstMap; c < image.firstMap + image.maps; ++c) {
    const float colors = (variance(0) + variance(1) + variance(2)) / 3.0f;
    target.counts[std::size_t(c)] = std::min(1.0f, variance(c) / std::max(colors, 1e-12f));
  }
  target.bins.resize(image.data.size());
  forEachIndex(target.bins.size(), [&](std::uint32_t i) { target.bins[i] = binsOf(target, image.at(i)); });
  const std::size_t width = std::size_t(image.width), count = width * std::size_t(image.height);
  target.exemplar = shares(count, image.channels, [&](std::size_t i) {
    return target.bins[(i / width + std::size_t(image.margin)) * std::size_t(image.stride) + i % width +
                       std::size_t(image.margin)];
  });
  return target;
}

Histogram histogramOf(const HistogramTarget& target, const Values& values, int channels) {
  return shares(values.size(), channels, [&](std::size_t i) { return binsOf(target, values[i]); });
}

Histogram expectedHistogram(const HistogramTarget& target, const TexelImage& image, const Demand& demand) {
  if (demand.empty()) return target.exemplar;
  // Summed by row, then over rows in order: independent of the number of threads.
  std::vector<Histogram> rows(std::size_t(image.height));
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const float weight = demand.at(float(x), float(y));
      const Bins& bins = target.bins[image.nearest(float(x), float(y))];
      for (int c = 0; c < image.channels; ++c) rows[std::size_t(y)].share[c][bins[c]] += weight;
    }
  });
  Histogram result;
  for (int c = 0; c < image.channels; ++c) {
    float whole = 0.0f;
    for (int b = 0; b < kHistogramBins; ++b) {
      for (const Histogram& row : rows) result.share[c][b] += row.share[c][b];
      whole += result.share[c][b];
    }
    for (float& share : result.share[c]) share /= whole;
  }
  return result;
}

HistogramWeights::HistogramWeights(const HistogramTarget& target, const Histogram& expected,
                                   const Histogram& surface, const TexelImage& image, double strength,
                                   std::size_t reads)
    : m_bins(target.bins), m_channels(image.channels) {
  for (int c = 0; c < image.channels; ++c)
    for (int b = 0; b < kHistogramBins; ++b)
      if (c != image.guide)
        m_excess[c][b] = float(strength * kHistogramBins) * target.counts[std::size_t(c)] *
                         std::max(0.0f, surface.share[c][b] - expected.share[c][b]);
  if (reads < m_bins.size()) return;
  m_all.resize(m_bins.size());
  forEachIndex(m_all.size(), [&](std::uint32_t i) { m_all[i] = of(m_bins[i]); });
}

float HistogramWeights::of(const Bins& bins) const {
  float sum = 1.0f;
  for (int c = 0; c < m_channels; ++c) sum += m_excess[c][bins[c]];
  return 1.0f / sum;
}

}  // namespace fluidtex::texture
