// Later frames: what the flow carried is kept where it is good, and renewed in discs where it is not.
#pragma once

#include "texture/passes.h"

namespace fluidtex::texture {

struct LaterFrame {
  Labels labels;
  std::vector<std::uint8_t> renewed;  // #V: 1 where the label is not the carried one
  std::vector<float> fadingSpeed;     // #V, 1/s: of what is renewed now
};

LaterFrame synthesizeLater(Synthesizer& synthesizer, const MeshView& view, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats, const Progress& progress);

}  // namespace fluidtex::texture
