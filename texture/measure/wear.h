// How much texture the flow wears out.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Renewal and change that the flow itself requires in a frame, whatever the texture: the scale for `renewed`
// and `change`.
struct FlowWear {
  // Share of the texture worn out in the frame, if none may be compressed or stretched by more than 1.4: mean
  // over vertices of min(1, e / (2 log 1.4)), e the larger absolute principal strain (logarithmic) since the
  // last frame.
  double worn = 0.0;
  // `change` if worn texture fades evenly over its whole life to unrelated texture: sqrt(2) times the
  // standard deviation of the exemplar's luminance times the rms of that share.
  double change = 0.0;
};

// Standard deviation of an exemplar's luminance as seen. color: linear RGBA.
double deviationOfLuminance(const Image& color);

// Nothing if no vertex was there before. deviation: deviationOfLuminance() of the exemplar.
std::optional<FlowWear> measureFlowWear(const TexturedSurface& surface, double deviation);

}  // namespace fluidtex::texture
