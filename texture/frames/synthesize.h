// Surface texture optimisation [Kwatra07 sec. V], with exemplar coordinates as the carried state.
#pragma once

#include "texture/optimize/synthesizer.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <functional>

namespace fluidtex::texture {

// Textures an oriented surface. First frame (carried empty): coarse to fine over all levels of the surface.
// Later frames: level 0 only, started from and softly held to what was carried. `frame` keys the random
// numbers together with the seed. secondsSinceLast is added to the age of every vertex that keeps its carried
// texture. `velocity`, `contact` and `maps` of the result are left for the caller to fill. trust and
// previousPosition are the carried ones; on the first frame, where nothing was carried, 0 and the positions
// themselves. Throws std::invalid_argument if an array's length is wrong or the surface has no orientation.
TexturedSurface synthesize(Synthesizer& synthesizer, Surface surface, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats,
                           const std::function<void(double)>& progress = {});

}  // namespace fluidtex::texture
