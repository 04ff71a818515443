// The gradient of exemplar coordinates as the coordinates themselves show it.
#pragma once

#include "texture/orientation/tangent.h"
#include "texture/surface.h"

#include <array>
#include <optional>
#include <vector>

namespace fluidtex::texture {

// A surface's coordinates on an exemplar of its size that wraps or does not. Refers to both.
struct Coordinates {
  const TexturedSurface& surface;
  const VertexGraph& graph;
  bool toroidal = false;

  // a - b, the short way around where the exemplar wraps.
  Vec2f difference(const Vec2f& a, const Vec2f& b) const;
  // Where x lies in v's axes, texels.
  Vec2f local(std::uint32_t v, const Vec3f& x) const;
};

// d(texel) / d(local), row 0 (s), then row 1 (t).
using Jacobian = std::array<float, 4>;

inline Vec2f times(const Jacobian& j, const Vec2f& l) {
  return {j[0] * l[0] + j[1] * l[1], j[2] * l[0] + j[3] * l[1]};
}

// max(s1, 1 / s2), s1 and s2 being the singular values; infinite where s2 is 0.
float distortion(const Jacobian& j);

// At each vertex the gradient that most of its neighbours agree with, fitted to those; none where no two of
// them lie as an exemplar drawn out or shrunk by less than four would have it.
std::vector<std::optional<Jacobian>> fittedGradients(const Coordinates& coordinates);

// Whether two neighbours' gradients each put the other where it is, within 0.75 texels in the mean.
bool cohere(const Coordinates& coordinates, const std::vector<std::optional<Jacobian>>& gradient,
            std::uint32_t v, std::uint32_t u);

}  // namespace fluidtex::texture
