// Change of the texture from frame to frame.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Measures of change between two frames, over the vertices of the later one that were on the surface before:
// those whose trust is at least kNewSurface and whose previous position lies within a quarter of the spacing
// of the earlier surface. Colours are sRGB-encoded, 0..1, over mid grey.
struct Change {
  // 99.9th percentile, over vertices, of the absolute difference from the earlier frame's colour at the
  // previous position (barycentric), mean over R, G and B.
  double pop = 0.0;
  // rms over vertices of the luminance difference from the advected earlier frame. That is the exemplar at
  // the transported coordinate (at the present one if within half a texel), plus the earlier frame's
  // difference from the exemplar at its own coordinate, as in a cross-fade. Excludes the error of resampling.
  double change = 0.0;
  double renewed = 0.0;  // share of the vertices whose coordinate is not the transported one
  // Mean over vertices of the difference as in `pop`, with the earlier frame read by a Gaussian kernel.
  double alongFlow = 0.0;
  // (alongFlow - e) / (s - e): 0 for pure advection, 1 for unrelated texture. e: error of that kernel,
  // estimated on the earlier frame. s: the same mean, with the earlier colours of randomly chosen vertices.
  double ratio = 0.0;
};

// after.previousPosition lies on `before`. color: the exemplar, linear RGBA. Nothing if no vertex was on the
// surface before. Throws std::invalid_argument if the mesh of `before` is not closed and manifold.
std::optional<Change> measureChange(const TexturedSurface& before, const TexturedSurface& after,
                                    const Image& color, bool toroidal);

}  // namespace fluidtex::texture
