// Histogram weights [Kopf07 sec. 4.3]: texels whose values the surface has too many of count less in the
// average, so that the surface keeps the exemplar's histogram.
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/labels/guidance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::texture {

inline constexpr int kHistogramBins = 16;

// Share of each bin, per channel; a channel's shares sum to 1. Bins divide the exemplar's range of values
// evenly; values beyond it fall into the end bins.
struct Histogram {
  std::array<std::array<float, kHistogramBins>, kMaxChannels> share{};
};

// Bin of each channel.
using Bins = std::array<std::uint8_t, kMaxChannels>;

struct HistogramTarget {
  Float8 low{}, scale{};  // bin = clamp((value - low) * scale)
  Histogram exemplar;
  // Weight per channel: 1, or for matched maps, whose amplitude is arbitrary, their variance over the mean of
  // the colour channels', 1 at most.
  std::array<float, kMaxChannels> counts{};
  std::vector<Bins> bins;  // per texel of image.data
};

HistogramTarget makeHistogramTarget(const TexelImage& image);
Histogram histogramOf(const HistogramTarget& target, const Values& values, int channels);

// The histogram that the surface should have: the exemplar's, each texel weighted by the demand for it. It is
// target.exemplar where the surface is unguided.
Histogram expectedHistogram(const HistogramTarget& target, const TexelImage& image, const Demand& demand);

// Weight of texel i of image.data: 1 / (1 + strength * excess). The excess sums, over the channels but the
// guidance map, how much the surface's share of the texel's bin exceeds the expected one, in units of the
// mean share 1 / kHistogramBins, times the channel's weight. Keeps a reference to the target.
class HistogramWeights {
 public:
  // reads: expected number of look-ups. If it is less than the number of texels, weights are computed on
  // demand.
  HistogramWeights(const HistogramTarget& target, const Histogram& expected, const Histogram& surface,
                   const TexelImage& image, double strength, std::size_t reads);
  float operator[](std::size_t i) const { return m_all.empty() ? of(m_bins[i]) : m_all[i]; }

 private:
  float of(const Bins& bins) const;

  std::array<std::array<float, kHistogramBins>, kMaxChannels> m_excess{};
  const std::vector<Bins>& m_bins;
  int m_channels;
  std::vector<float> m_all;
};

}  // namespace fluidtex::texture
