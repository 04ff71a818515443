// Later frames: transported texture is kept where it is coherent and hardly stretched, and renewed in discs
// elsewhere.
#pragma once

#include "texture/optimize/passes.h"

namespace fluidtex::texture {

struct LaterFrame {
  Labels labels;
  std::vector<std::uint8_t> renewed;  // #V: 1 where the label is not the transported one
  std::vector<float> fadingSpeed;     // #V, 1/s: least decrease of cross-fade weights in this frame
};

struct FrameTime {
  int index = 0;                  // of the frame
  double secondsSinceLast = 0.0;  // since the transported frame, s
};

// Textures a frame from the transported one. `view` is of the surface's finest level. Where the surface has
// coarser levels too, fresh regions that a window fits into are textured coarse to fine like a first frame.
LaterFrame synthesizeLater(Synthesizer& synthesizer, const Surface& surface, const MeshView& view,
                           const Carried& carried, const FrameTime& frame, SynthesisStats& stats,
                           const Progress& progress);

}  // namespace fluidtex::texture
