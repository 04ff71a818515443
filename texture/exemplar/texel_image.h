// A pyramid level of the exemplar in the layout of the optimisation. A texel has eight channels, unused ones
// zero. The image is padded on all sides, so that windows are read without bounds checks. Half precision,
// since wide windows read all over the image and would not fit into a cache.
#pragma once

#include "numerics/lanes.h"
#include "texture/exemplar/exemplar.h"

#include <vector>

namespace fluidtex::texture {

// Channels at the vertices (#V); the first `channels` lanes are used.
using Values = std::vector<Float8>;

inline constexpr int kMaxChannels = 8;

struct TexelImage {
  int width = 0, height = 0, channels = 0;
  int margin = 0, stride = 0;  // stride = width + 2 margin, texels
  bool toroidal = false;
  Ways ways;                    // allowed symmetry variants
  int guide = -1;               // channel of the guidance map; -1: none
  float guidanceWeight = 1.0f;  // the channel is multiplied by its square root
  int firstMap = 0, maps = 0;   // first channel and number of matched maps
  std::vector<Half8> data;      // rows from the top, with margins

  Float8 at(std::size_t texel) const { return widened(data[texel]); }

  // Bilinear. Precondition: at most margin - 1 texels outside the image.
  Float8 sampleInside(float x, float y) const {
    x += float(margin);
    y += float(margin);
    const int i = int(x), j = int(y);
    const float fx = x - float(i), fy = y - float(j);
    const Half8* row = data.data() + std::size_t(j) * stride + i;
    const auto between = [&](const Half8* texel) {
      const Float8 left = widened(texel[0]);
      return left + fx * (widened(texel[1]) - left);
    };
    const Float8 above = between(row);
    return above + fy * (between(row + stride) - above);
  }

  // Bilinear anywhere: clamped, or wrapped where toroidal.
  Float8 sample(const Vec2f& texel) const {
    const Vec2f t = brought(texel);
    return sampleInside(t[0], t[1]);
  }

  // The nearest position inside: clamped to texel centres, or wrapped to 0 <= x < width.
  Vec2f brought(const Vec2f& texel) const {
    const bool inside =
        texel[0] >= 0.0f && texel[1] >= 0.0f && texel[0] <= float(width - 1) && texel[1] <= float(height - 1);
    return inside ? texel : broughtFromOutside(texel);
  }
  Vec2f broughtFromOutside(const Vec2f& texel) const;

  // The nearest valid centre of a window that reaches `reach` texels to every side.
  Vec2f centerFor(const Vec2f& texel, float reach) const;

  // Index into `data` (and arrays of its shape) of the texel nearest to a position valid for sampleInside().
  std::size_t nearest(float x, float y) const {
    return std::size_t(int(y + float(margin) + 0.5f)) * stride + std::size_t(int(x + float(margin) + 0.5f));
  }
};

// Throws std::invalid_argument if the image has more than kMaxChannels channels.
TexelImage makeTexelImage(const Image& image, bool toroidal, int margin);

// Root mean square difference of two random texels: the unit of differences.
float randomDifference(const TexelImage& image, const Float8& channelWeight);

}  // namespace fluidtex::texture
