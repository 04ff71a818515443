// Surface texture optimisation [Kwatra07 sec. V], with exemplar coordinates as the transported state.
#pragma once

#include "texture/optimize/synthesizer.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <functional>

namespace fluidtex::texture {

// Textures an oriented surface.
// First frame (`carried` empty): coarse to fine over all levels. Later frames: from the transported texture,
// on level 0 (and on coarser levels where wide fresh surface needs them).
// frame: keys the random numbers, with the seed. secondsSinceLast, s: added to the age of vertices that keep
// their texture. progress: called with 0..1.
// Result: all of VertexTexture (what is renewed is not original), the exemplar's size, and the exemplar's
// further maps; `velocity` and `contact` are left to the caller. trust and previousPosition are the
// transported ones; on the first frame 0 and the positions. Throws std::invalid_argument if an array has the
// wrong length or the surface has no orientation.
TexturedSurface synthesize(Synthesizer& synthesizer, Surface surface, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats,
                           const std::function<void(double)>& progress = {});

}  // namespace fluidtex::texture
