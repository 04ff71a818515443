// Synthesis without transported texture: the first frame that has a surface, and wide fresh surface later on.
#pragma once

#include "texture/optimize/passes.h"

namespace fluidtex::texture {

// Coarse to fine from random blocks of the exemplar, from the coarsest level down to level `finest` (0 is the
// finest). Returns the state of that level. Adds to stats.
State synthesizeFromNothing(Synthesizer& synthesizer, const Surface& surface, int finest, int frame,
                            SynthesisStats& stats, const Progress& progress);

}  // namespace fluidtex::texture
