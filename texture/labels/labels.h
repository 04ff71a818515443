// Labels: where in the exemplar each vertex comes from, and how the exemplar lies around it. They are the
// state that the optimisation leaves behind and that is carried from frame to frame.
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
  // d(texel) / d(l), l the local coordinates in the vertex's own axes, pixels: row 0 (s) then row 1 (t). A
  // rotation where the texture lies unstretched.
  std::array<float, 4> jacobian{1.0f, 0.0f, 0.0f, 1.0f};

  // The texel that this label puts at local coordinates l.
  Vec2f at(const Complexf& l) const {
    return Vec2f(texel[0] + jacobian[0] * l.real() + jacobian[1] * l.imag(),
                 texel[1] + jacobian[2] * l.real() + jacobian[3] * l.imag());
  }
};
using Labels = std::vector<Label>;

// How an exemplar lies that is not stretched: an offset on the surface is mirrored (first component negated),
// if at all, then turned, and is one in the exemplar.
struct Lay {
  Complexf turn{1.0f};  // unit
  bool mirrored = false;
};

// The same, for axes that `rotation` takes to those it was for.
inline Lay seenFrom(const Lay& lay, const Complexf& rotation) {
  return {lay.mirrored ? conjugateProduct(rotation, lay.turn) : product(lay.turn, rotation), lay.mirrored};
}

// Of those that an exemplar may have, the unstretched one nearest to a label; upright where none is.
Lay layOf(const Label& label, const Ways& ways);

// Whether a label shows its mirror image.
inline bool isMirrored(const Label& label) {
  return label.jacobian[0] * label.jacobian[3] < label.jacobian[1] * label.jacobian[2];
}

Label unstretched(const Vec2f& texel, const Lay& lay);

// How far a label is from that: the larger of its greatest magnification and its greatest reduction, 1 =
// unstretched, very large where it is torn.
float stretch(const Label& label);

Label labelOf(const SurfaceMesh& mesh, std::uint32_t v, const Vec2f& coordinate,
              const TexelGradient& gradient);
Labels labelsOf(const SurfaceMesh& mesh, const std::vector<Vec2f>& coordinate,
                const std::vector<TexelGradient>& gradient);
TexelGradient gradientOf(const Label& label, const Vec3f& orientation, const Vec3f& normal, double spacing);

// Channels looked up at the labels.
Values lookUp(const TexelImage& image, const Labels& labels);

// Random blocks: the surface is divided among seeds about `size` pixels apart, and each part gets one
// contiguous block of the exemplar, from a random place, where guided one of the level that is wanted.
Labels blockLabels(const MeshView& view, const TexelImage& image, float size, std::uint64_t seed);

// Labels for a finer level, whose exemplar is twice as large, from the nearest vertex of the coarser one that
// faces the same way.
Labels refineLabels(const SurfaceMesh& coarse, const Labels& labels, const SurfaceMesh& fine,
                    const TexelImage& fineImage);

// a - b; on an exemplar that wraps, positions differ by whole turns without meaning it.
inline Vec2f texelDifference(const TexelImage& image, const Vec2f& a, const Vec2f& b) {
  const auto shortest = [](float d, float size) {
    return std::abs(d) <= 0.5f * size ? d : d - size * std::floor(d / size + 0.5f);
  };
  const Vec2f d = a - b;
  return image.toroidal ? Vec2f(shortest(d[0], float(image.width)), shortest(d[1], float(image.height))) : d;
}

// Whether a texel lies on the exemplar, within half a texel; on one that wraps all do.
inline bool liesOn(const TexelImage& image, const Vec2f& texel) {
  return image.toroidal || (texel - image.brought(texel)).lengthSqr() <= 0.25f;
}

// A label continued to a neighbouring vertex; `edge` and `rotation` are that vertex's, towards the label's
// own.
Label continued(const TexelImage& image, const Label& label, const Complexf& edge, const Complexf& rotation);

// Beyond the edge of an exemplar that does not wrap, labels are continued by what lies at its edge, or not.
enum class HandOn { everywhere, inside };

// Continues the labels of `placed` vertices (#V) ring by ring over the `wanted` ones (#V) that hang together
// with them; each takes that of the nearest neighbour that has one.
void handOn(const TexelImage& image, const MeshView& view, const std::vector<std::uint8_t>& wanted,
            std::vector<std::uint8_t> placed, Labels& labels, HandOn how = HandOn::everywhere);

// Two labels continue each other where each puts, at the other's place, a texel this near to the other's (the
// mean of both).
inline constexpr float kCoherent = 0.75f;

}  // namespace fluidtex::texture
