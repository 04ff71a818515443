// Gradients of the exemplar coordinate, estimated from the coordinates themselves.
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/surface.h"

#include <array>
#include <optional>
#include <vector>

namespace fluidtex::texture {

// A surface with its graph, and whether its exemplar is toroidal. Keeps references.
struct Coordinates {
  const TexturedSurface& surface;
  const VertexGraph& graph;
  bool toroidal = false;

  // a - b, the shortest where the exemplar is toroidal; texels.
  Vec2f difference(const Vec2f& a, const Vec2f& b) const;
  // Local coordinates of x in v's axes, pixels.
  Vec2f local(std::uint32_t v, const Vec3f& x) const;
};

// d(texel) / d(local): row 0 (s), then row 1 (t).
using Jacobian = std::array<float, 4>;

inline Vec2f times(const Jacobian& j, const Vec2f& l) {
  return {j[0] * l[0] + j[1] * l[1], j[2] * l[0] + j[3] * l[1]};
}

// Largest of s1 and 1 / s2, singular values s1 >= s2; infinite where s2 is 0.
float distortion(const Jacobian& j);

// #V. Each pair of consecutive edges proposes a gradient, of distortion 4 at most; the one that most
// neighbours agree with is fitted to these by least squares. None where no pair proposes one.
std::vector<std::optional<Jacobian>> fittedGradients(const Coordinates& coordinates);

// Whether the gradients at u and v predict each other's coordinates within 0.75 texels on average.
bool cohere(const Coordinates& coordinates, const std::vector<std::optional<Jacobian>>& gradient,
            std::uint32_t v, std::uint32_t u);

}  // namespace fluidtex::texture
