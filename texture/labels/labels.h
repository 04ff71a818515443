// Labels: exemplar coordinate and Jacobian of each vertex. They are the state that the optimisation produces
// and that is transported from frame to frame.
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/loops/complex.h"
#include "texture/neighborhood/neighborhood.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace fluidtex::texture {

struct Label {
  Vec2f texel{0.0f, 0.0f};
  // d(texel) / d(l) with l the local coordinates in the vertex's axes, pixels: row 0 (s), then row 1 (t). A
  // rotation where the texture is isometric.
  std::array<float, 4> jacobian{1.0f, 0.0f, 0.0f, 1.0f};

  // Texel that this label predicts at local coordinates l.
  Vec2f at(const Complexf& l) const {
    return Vec2f(texel[0] + jacobian[0] * l.real() + jacobian[1] * l.imag(),
                 texel[1] + jacobian[2] * l.real() + jacobian[3] * l.imag());
  }
};
using Labels = std::vector<Label>;

// An isometric placement of the exemplar: an offset on the surface becomes one in the exemplar by mirroring
// (first component negated), if `mirrored`, then by rotation.
struct Lay {
  Complexf turn{1.0f};  // unit
  bool mirrored = false;
};

// The same placement in the axes of another vertex. rotation: unit complex number that rotates local
// coordinates from those axes to the axes of `lay`.
inline Lay seenFrom(const Lay& lay, const Complexf& rotation) {
  return {lay.mirrored ? conjugateProduct(rotation, lay.turn) : product(lay.turn, rotation), lay.mirrored};
}

// The isometric placement nearest to a label, mirrored only if `ways` allows it; upright for a zero Jacobian.
Lay layOf(const Label& label, const Ways& ways);

// Whether the Jacobian's determinant is negative.
inline bool isMirrored(const Label& label) {
  return label.jacobian[0] * label.jacobian[3] < label.jacobian[1] * label.jacobian[2];
}

// The label with the isometric Jacobian of a placement.
Label unstretched(const Vec2f& texel, const Lay& lay);

// Largest of s1 and 1 / s2, singular values s1 >= s2 of the Jacobian: 1 where the texture is isometric, 1000
// at most.
float stretch(const Label& label);
// The same of a gradient, for an exemplar pixel of `spacing` metres.
float stretch(const TexelGradient& gradient, double spacing);

// The label at vertex v: coordinate in texels, gradient in texels per metre. Requires mesh.orientation.
Label labelOf(const SurfaceMesh& mesh, std::uint32_t v, const Vec2f& coordinate,
              const TexelGradient& gradient);
// The same for all vertices, #V.
Labels labelsOf(const SurfaceMesh& mesh, const std::vector<Vec2f>& coordinate,
                const std::vector<TexelGradient>& gradient);
// Gradient of a label, texels per metre. orientation, normal: of its vertex, unit. spacing: spacingAt()
// there, metres.
TexelGradient gradientOf(const Label& label, const Vec3f& orientation, const Vec3f& normal, double spacing);

// Channels of the image at the labels.
Values lookUp(const TexelImage& image, const Labels& labels);

// Initial labels: the surface is divided among seeds about `size` pixels apart, and each part gets one
// contiguous block from a random place in the exemplar; where guided, from one of the wanted level.
Labels blockLabels(const MeshView& view, const TexelImage& image, float size, std::uint64_t seed);

// Labels of a finer level, whose exemplar is twice as large, from the nearest vertex of the coarser level
// that faces the same way.
Labels refineLabels(const SurfaceMesh& coarse, const Labels& labels, const SurfaceMesh& fine,
                    const TexelImage& fineImage);

// a - b; the shortest difference where the exemplar is toroidal.
inline Vec2f texelDifference(const TexelImage& image, const Vec2f& a, const Vec2f& b) {
  const auto shortest = [](float d, float size) {
    return std::abs(d) <= 0.5f * size ? d : d - size * std::floor(d / size + 0.5f);
  };
  const Vec2f d = a - b;
  return image.toroidal ? Vec2f(shortest(d[0], float(image.width)), shortest(d[1], float(image.height))) : d;
}

// Whether a texel lies on the exemplar, within half a texel; always on a toroidal one.
inline bool liesOn(const TexelImage& image, const Vec2f& texel) {
  return image.toroidal || (texel - image.brought(texel)).lengthSqr() <= 0.25f;
}

// A label continued to a neighbouring vertex. `edge` and `rotation`: connection of that vertex's half-edge
// towards the label's vertex.
Label continued(const TexelImage& image, const Label& label, const Complexf& edge, const Complexf& rotation);

// Whether labels are continued beyond the edge of an exemplar that is not toroidal: by the texels at its
// edge, or not at all.
enum class HandOn { everywhere, inside };

// Continues the labels of `placed` vertices (#V) ring by ring over the `wanted` ones (#V) connected to them;
// each takes that of its nearest placed neighbour.
void handOn(const TexelImage& image, const MeshView& view, const std::vector<std::uint8_t>& wanted,
            std::vector<std::uint8_t> placed, Labels& labels, HandOn how = HandOn::everywhere);

// Texels. Two labels continue each other if each predicts the other's texel with an error below this,
// averaged over both.
inline constexpr float kCoherent = 0.75f;

}  // namespace fluidtex::texture
