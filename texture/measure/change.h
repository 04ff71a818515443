// Change of the texture from frame to frame.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Measures of change between two frames. Vertices of new surface are left out: those whose previous position
// is off the last one by more than a quarter of the spacing.
struct Change {
  // 99.9th percentile, over vertices, of the change along the flow: mean over R, G, B of the difference from
  // the last frame's colour at the previous position, interpolated.
  double pop = 0.0;
  // rms difference of luminance between the picture and the last one advected: the exemplar at the
  // transported coordinate (at the present one if within half a texel), plus the last picture's difference
  // from the exemplar at its own coordinate, as in a cross-fade. Excludes the error of resampling.
  double change = 0.0;
  double renewed = 0.0;  // share of the vertices whose coordinate is not the transported one
  double alongFlow =
      0.0;             // mean change along the flow, R, G and B, with the last frame read by a smooth kernel
  double ratio = 0.0;  // the same minus that reading's error, over shuffled vertices': 0 advected, 1 fresh
};

// after.previousPosition lies on `before`. Nothing if no vertex was there before.
std::optional<Change> measureChange(const TexturedSurface& before, const TexturedSurface& after,
                                    const Image& color, bool toroidal);

}  // namespace fluidtex::texture
