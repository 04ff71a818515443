// From exemplar coordinates to pixels of another image over the same picture.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <stdexcept>

namespace fluidtex::texture {

// Maps texels of a surface's exemplar to pixels of an image of any size. Throws std::invalid_argument if the
// image is empty or the exemplar's size unknown.
class TexelToImage {
 public:
  TexelToImage(const TexturedSurface& surface, const Image& image)
      : TexelToImage(surface.exemplarWidth, surface.exemplarHeight, image) {}
  TexelToImage(int exemplarWidth, int exemplarHeight, const Image& image)
      : m_scale(float(image.width) / float(exemplarWidth), float(image.height) / float(exemplarHeight)) {
    if (image.data.empty()) throw std::invalid_argument("map of the exemplar: it has no pixels");
    if (exemplarWidth < 1 || exemplarHeight < 1)
      throw std::invalid_argument("map of the exemplar: the surface does not know the exemplar's size");
  }
  // Centres lie at integers in both.
  Vec2f operator()(const Vec2f& texel) const {
    const Vec2f half(0.5f, 0.5f);
    return (texel + half) * m_scale - half;
  }

 private:
  Vec2f m_scale;
};

// Weight of a vertex's former colour, 0..1.
inline float leftOf(const Fading& fading, std::uint32_t v) {
  return fading.weight.empty() ? 0.0f : fading.weight[v];
}

}  // namespace fluidtex::texture
