// An exemplar laid on surfaces, for tests of the optimisation.
#pragma once

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "texture/optimize/optimize.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::testing {

using namespace fluidtex::texture;

// An exemplar level in all the forms that a pass wants.
struct Source {
  Source(const Image& from, bool toroidal)
      : match(from), image(makeTexelImage(from, toroidal, 24)), histogram(makeHistogramTarget(image)) {}
  Image match;
  TexelImage image;
  HistogramTarget histogram;
};

// The exemplar laid down whole on the upper side of a flat box: the texel at vertex (x, y) is `corner` + (x,
// -y).
inline Labels laidDown(const OrientedMesh& surface, const Vec2f& corner) {
  Labels labels;
  for (const Vec3f& x : surface.mesh.positions)
    labels.push_back(unstretched(corner + Vec2f(x.x(), -x.y()), {}));
  return labels;
}

// Vertices of the upper side that are at least `margin` from its rim.
inline std::vector<std::uint8_t> middle(const OrientedMesh& surface, float margin, float size) {
  std::vector<std::uint8_t> mask;
  for (const Vec3f& x : surface.mesh.positions)
    mask.push_back(x.z() > 1.9f && x.x() > margin && x.x() < size - margin && x.y() > margin &&
                   x.y() < size - margin);
  return mask;
}

inline float difference(const Values& a, const Values& b) {
  float worst = 0.0f;
  for (std::size_t v = 0; v < a.size(); ++v) {
    const Float8 d = a[v] - b[v];
    worst = std::max(worst, std::sqrt(sum8(d * d)));
  }
  return worst;
}

}  // namespace fluidtex::testing
