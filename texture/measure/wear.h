// What the flow wears out.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// What the flow alone asks for in a frame, whatever the texture: by what `renewed` and `change` can be
// judged.
struct FlowWear {
  // Share of the texture that the frame wears out, if none is to be squeezed or drawn out by more than 1.4:
  // mean over the vertices of min(1, e / (2 log 1.4)), e being the greater principal strain (logarithmic) of
  // the surface since the last frame.
  double worn = 0.0;
  // `change` if all that is worn gives way over its whole life, evenly, to texture that has nothing to do
  // with it: sqrt(2) times the deviation of the exemplar's luminance times the rms of the same share.
  double change = 0.0;
};

// Standard deviation of an exemplar's luminance, as it is seen. color: linear RGBA.
double deviationOfLuminance(const Image& color);

// Nothing where no vertex was there before. deviation: the exemplar's, as above.
std::optional<FlowWear> measureFlowWear(const TexturedSurface& surface, double deviation);

}  // namespace fluidtex::texture
