// Guidance: which parts of the exemplar appear where. A map beside the exemplar says of every texel what
// level it is of, 0..1; SurfaceMesh::guidance says what level is wanted at a vertex. Windows compare the two
// like any other channel, labels pay for what does not fit, and what the exemplar's histogram and its even
// use ask for is taken of the parts that are wanted.
#pragma once

#include "texture/labels/labels.h"

#include <vector>

namespace fluidtex::texture {

// Whether there is a map, and levels that are wanted.
bool isGuided(const TexelImage& image, const SurfaceMesh& mesh);

// Puts the wanted levels into the map's channel. Where nothing is guided: leaves the values alone.
void holdGuidance(const TexelImage& image, const SurfaceMesh& mesh, Values& values);

// By how much the level at a texel is off what is wanted at v, times the weight of guidance; what is off by
// less than kFittingLevel fits. 0 where nothing is guided. In the units of a log stretch.
float guidanceCost(const TexelImage& image, const SurfaceMesh& mesh, const Vec2f& texel, std::uint32_t v);
inline constexpr float kFittingLevel = 0.1f;

// How much of the surface asks for each part of the exemplar, 1 on average: a grid of cells, a little
// blurred, since texels appear together with those around them. Empty where nothing is guided.
struct Demand {
  int columns = 0, rows = 0;
  std::vector<float> share;  // rows from the top
  bool empty() const { return share.empty(); }
  float at(float x, float y) const;  // texels, inside the image
};
Demand demandOn(const TexelImage& image, const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
