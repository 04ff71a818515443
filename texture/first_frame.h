// The first frame that has a surface: its texture is grown from nothing.
#pragma once

#include "texture/passes.h"

namespace fluidtex::texture {

// Coarse to fine from random blocks of the exemplar. Leaves the state of level 0.
State synthesizeFirst(Synthesizer& synthesizer, const Surface& surface, int frame, SynthesisStats& stats,
                      const Progress& progress);

}  // namespace fluidtex::texture
