// Later frames: what the flow carried is kept where it is good, and renewed in discs where it is not.
#pragma once

#include "texture/optimize/passes.h"

namespace fluidtex::texture {

struct LaterFrame {
  Labels labels;
  std::vector<std::uint8_t> renewed;  // #V: 1 where the label is not the carried one
  std::vector<float> fadingSpeed;     // #V, 1/s: the least at which what fades gives way in this frame
};

// `view` is of the surface's finest level. Where it has coarser ones too, surface that has just come to
// light, and that a window fits into, is textured coarse to fine like a first frame.
LaterFrame synthesizeLater(Synthesizer& synthesizer, const Surface& surface, const MeshView& view,
                           const Carried& carried, int frame, double secondsSinceLast, SynthesisStats& stats,
                           const Progress& progress);

}  // namespace fluidtex::texture
