// Surface texture optimisation [Kwatra07 sec. V], with exemplar coordinates as the carried state.
#pragma once

#include "texture/exemplar.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <functional>
#include <memory>

namespace fluidtex::texture {

struct SearchTables;  // per exemplar, level and window: PCA basis, descriptors and tree; made on first use
                      // and kept

struct Synthesizer {
  Exemplar exemplar;
  SynthesisOptions options;
  std::shared_ptr<SearchTables> tables;
  CacheFolder cache;  // in which search tables are kept from run to run (texture/table_cache.h)
  Image around;  // lightnessAround(exemplar)
};

// Throws std::invalid_argument if no window fits the exemplar, or options.windows is empty. cache: empty for
// none.
Synthesizer makeSynthesizer(Exemplar exemplar, const SynthesisOptions& options,
                            CacheFolder cache = {});

// Makes the tables of all levels and windows now, not when they are first asked for.
void prepareTables(Synthesizer& synthesizer);

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
