// Pieces of the exemplar, and the joints between them.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/measure/new_surface.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// What one frame's exemplar coordinates show. Two neighbours cohere where each one's gradient, fitted to its
// neighbours, puts the other within 0.75 texels (mean of both) of where it is; pieces are what coheres.
// Surface that is new in its frame (trust below kNewSurface) is left out, unless all is.
struct Pieces {
  // 95th percentile of max(s1, 1 / s2), s the singular values of the fitted gradients (texels a texel), over
  // vertices that cohere with three neighbours or more; 1 is undistorted.
  double shape = 0.0;
  // rms difference of colour a texel across edges between pieces, over that between texels side by side in
  // the exemplar; 0 without such edges.
  double seams = 0.0;
  double joints = 0.0;  // share of the edges that lie between pieces
  double chips = 0.0;   // share of the vertices in pieces of fewer than 25
  int pieces = 0;
};

// Nothing without a surface.
std::optional<Pieces> measurePieces(const TexturedSurface& surface, const Image& color, bool toroidal);

}  // namespace fluidtex::texture
