// An exemplar made ready for synthesis: its levels, and the tables they are searched by.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/options.h"

#include <memory>

namespace fluidtex::texture {

struct SearchTables;  // per exemplar, level and window: PCA basis, descriptors and tree; made on first use
                      // and kept

struct Synthesizer {
  Exemplar exemplar;
  SynthesisOptions options;
  std::shared_ptr<SearchTables> tables;
  CacheFolder cache;  // in which search tables are kept from run to run (texture/search/table_cache.h)
  Image around;       // lightnessAround(exemplar)
};

// Throws std::invalid_argument if no window fits the exemplar, or options.windows is empty. cache: empty for
// none.
Synthesizer makeSynthesizer(Exemplar exemplar, const SynthesisOptions& options, CacheFolder cache = {});

// Makes the tables of all levels and windows now, not when they are first asked for.
void prepareTables(Synthesizer& synthesizer);

}  // namespace fluidtex::texture
