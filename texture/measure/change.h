// What changes from frame to frame.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// What is new from one frame to the next. Vertices of new surface are left out.
struct Change {
  // 99.9th percentile of a vertex's change along the flow: mean over R, G, B of the difference from the last
  // frame's colour where the vertex was, read between its vertices.
  double pop = 0.0;
  // rms difference of luminance between what is shown and the last picture merely carried: the exemplar at
  // the carried coordinate (at the shown one where it is the same within half a texel), plus what the last
  // picture differed from the exemplar at its own, as in a fade. What resampling costs is not in it.
  double change = 0.0;
  double renewed = 0.0;  // share of the vertices whose coordinate is not the carried one
  double alongFlow =
      0.0;             // mean change along the flow, R, G and B, with the last frame read by a smooth kernel
  double ratio = 0.0;  // the same less what that reading costs, over shuffled vertices': 0 carried, 1 fresh
};

// after.previousPosition lies on `before`. Nothing where no vertex was there before.
std::optional<Change> measureChange(const TexturedSurface& before, const TexturedSurface& after,
                                    const Image& color, bool toroidal);

}  // namespace fluidtex::texture
