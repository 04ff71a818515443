// Exemplar coordinates at vertices, and whether two of them are of one piece of texture.
#pragma once

#include "texture/surface.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {

// Exemplar coordinates with their gradients, #V each.
struct Places {
  std::vector<Vec2f> coordinate;  // texels
  std::vector<TexelGradient> gradient;
};

// What coordinates are compared by.
struct Torus {
  bool toroidal = false;
  Vec2f size{0.0f};  // of the exemplar, texels

  Torus(const TexturedSurface& surface, bool isToroidal)
      : toroidal(isToroidal && surface.exemplarWidth > 0 && surface.exemplarHeight > 0),
        size(float(surface.exemplarWidth), float(surface.exemplarHeight)) {}

  // q brought onto the exemplar, so that its share of the size, (q + 0.5) / size, lies in 0..1 as in files:
  // repeated where it is toroidal, else clamped.
  Vec2f brought(const Vec2f& q) const {
    Vec2f result = q;
    for (int i = 0; i < 2; ++i) {
      if (toroidal)
        result[i] -= size[i] * std::floor((q[i] + 0.5f) / size[i]);
      else if (size[i] > 0.0f)
        result[i] = std::clamp(q[i], -0.5f, size[i] - 0.5f);
    }
    return result;
  }

  // q, or where the exemplar is toroidal that repetition of q which is nearest to `near`.
  Vec2f unwrapped(const Vec2f& q, const Vec2f& near) const {
    if (!toroidal) return q;
    return {q[0] - size[0] * std::floor((q[0] - near[0]) / size[0] + 0.5f),
            q[1] - size[1] * std::floor((q[1] - near[1]) / size[1] + 0.5f)};
  }
};

// Coordinate that the piece at a point has `offset` (metres) away.
inline Vec2f continued(const Vec2f& coordinate, const TexelGradient& gradient, const Vec3f& offset) {
  return {coordinate[0] + gradient.s.dot(offset), coordinate[1] + gradient.t.dot(offset)};
}

// Mean deviation, texels, up to which two vertices that continue each other are of one piece.
inline constexpr float kOnePiece = 0.75f;

// Whether the coordinates at vertices a and b are of one piece: each, continued to the other by its gradient,
// is what stands there.
inline bool onePiece(const Torus& torus, const std::vector<Vec3f>& positions,
                     const std::vector<Vec2f>& coordinate, const std::vector<TexelGradient>& gradient,
                     std::uint32_t a, std::uint32_t b) {
  const Vec3f way = positions[b] - positions[a];
  const Vec2f there = continued(coordinate[a], gradient[a], way),
              here = continued(coordinate[b], gradient[b], -way);
  return (torus.unwrapped(coordinate[b], there) - there).length() +
             (torus.unwrapped(coordinate[a], here) - here).length() <
         2.0f * kOnePiece;
}

inline bool onePiece(const Torus& torus, const std::vector<Vec3f>& positions, const Places& places,
                     std::uint32_t a, std::uint32_t b) {
  return onePiece(torus, positions, places.coordinate, places.gradient, a, b);
}

}  // namespace fluidtex::texture
