// Histogram weights [Kopf07]: texels whose values the surface has too many of already count less in the
// average, so that all of the exemplar's values keep their share.
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/labels/guidance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::texture {

inline constexpr int kHistogramBins = 16;

// The share of each bin, for every channel; bins divide the range of the exemplar's channel evenly, values
// beyond it count for the bins at its ends. A channel's shares sum to 1.
struct Histogram {
  std::array<std::array<float, kHistogramBins>, kMaxChannels> share{};
};

// The bin of each channel.
using Bins = std::array<std::uint8_t, kMaxChannels>;

struct HistogramTarget {
  Float8 low{}, scale{};  // bin = clamp((value - low) * scale)
  Histogram exemplar;
  // How much a channel counts: 1; of matched maps, whose amplitude is a matter of choice, its variance in
  // mean colour channels', 1 at most.
  std::array<float, kMaxChannels> counts{};
  std::vector<Bins> bins;  // of every texel of image.data
};

HistogramTarget makeHistogramTarget(const TexelImage& image);
Histogram histogramOf(const HistogramTarget& target, const Values& values, int channels);

// The exemplar's own, each texel counted as often as it is asked for; target.exemplar where nothing is
// guided.
Histogram expectedHistogram(const HistogramTarget& target, const TexelImage& image, const Demand& demand);

// For texel i of image.data: 1 / (1 + strength * excess), where excess sums over the channels by how much the
// surface's share of the texel's bin exceeds the expected one, in mean shares (1 / kHistogramBins), times
// what the channel counts. The guidance map is left out. Refers to the target.
class HistogramWeights {
 public:
  // reads: about how many will be asked for; if fewer than there are texels, each is found when it is.
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
