// The first frame that has a surface: its texture is grown from nothing.
#pragma once

#include "texture/optimize/passes.h"

namespace fluidtex::texture {

// Coarse to fine from random blocks of the exemplar, down to level `finest`, whose state it leaves.
State synthesizeFromNothing(Synthesizer& synthesizer, const Surface& surface, int finest, int frame,
                            SynthesisStats& stats, const Progress& progress);

}  // namespace fluidtex::texture
