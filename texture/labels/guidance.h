// Guidance (texture-by-numbers): a map gives each texel of the exemplar a level 0..1, SurfaceMesh::guidance
// gives the level wanted at a vertex. Windows compare the two as one more channel; labels pay for a mismatch;
// histogram and usage follow the demand for each part of the exemplar.
#pragma once

#include "texture/labels/labels.h"

#include <vector>

namespace fluidtex::texture {

// Whether the exemplar has a guidance map and the mesh wanted levels.
bool isGuided(const TexelImage& image, const SurfaceMesh& mesh);

// Sets the guidance channel of `values` (#V) to the wanted levels times the square root of
// image.guidanceWeight, as the image's channel is scaled. Unguided: no change.
void holdGuidance(const TexelImage& image, const SurfaceMesh& mesh, Values& values);

// Cost of a texel at v, in units of log stretch: proportional to the weight of guidance and to the level's
// deviation from the wanted one beyond kFittingLevel. Unguided: 0.
float guidanceCost(const TexelImage& image, const SurfaceMesh& mesh, const Vec2f& texel, std::uint32_t v);
inline constexpr float kFittingLevel = 0.1f;

// Demand for each part of the exemplar, 1 on average, on a grid of cells of 8 x 8 texels. Slightly blurred,
// since texels appear together with their surroundings. Empty if unguided.
struct Demand {
  int columns = 0, rows = 0;
  std::vector<float> share;  // rows from the top
  bool empty() const { return share.empty(); }
  float at(float x, float y) const;  // texel, inside the image
};
Demand demandOn(const TexelImage& image, const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
