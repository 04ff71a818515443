// Patches of the exemplar, and the seams between them.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/measure/new_surface.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Measures of one frame's exemplar coordinates. Two neighbours cohere if the fitted gradient of each predicts
// the other's coordinate within 0.75 texels, averaged over both; pieces are the components of coherent
// vertices. New surface (trust below kNewSurface) is left out, unless all is.
struct Pieces {
  // 95th percentile of max(s1, 1 / s2), s the singular values of the fitted gradients (texels per texel),
  // over vertices that cohere with at least three neighbours; 1 is isometric.
  double shape = 0.0;
  double shapeMedian = 1.0, shapeWorst = 1.0;  // the 50th and the 99th percentile of the same
  // rms colour difference per texel across edges between pieces, over that between adjacent texels of the
  // exemplar; 0 without such edges.
  double seams = 0.0;
  double joints = 0.0;  // share of the edges that lie between pieces
  double chips = 0.0;   // share of the vertices in pieces of fewer than 25
  int pieces = 0;
};

// Nothing without a surface.
std::optional<Pieces> measurePieces(const TexturedSurface& surface, const Image& color, bool toroidal);

}  // namespace fluidtex::texture
