// An exemplar prepared for synthesis: its pyramid and search tables.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/options.h"

#include <memory>

namespace fluidtex::texture {

struct SearchTables;  // per exemplar, level and window: PCA basis, descriptors and tree; made on first use

struct Synthesizer {
  Exemplar exemplar;
  SynthesisOptions options;
  std::shared_ptr<SearchTables> tables;
  CacheFolder cache;  // folder of search tables kept between runs (texture/search/table_cache.h)
  Image around;       // lightnessAround(exemplar)
};

// cache: folder for search tables; empty: none. Throws std::invalid_argument if options.windows is empty or
// no window fits the exemplar.
Synthesizer makeSynthesizer(Exemplar exemplar, const SynthesisOptions& options, CacheFolder cache = {});

// Makes the tables of all levels and windows now instead of on first use.
void prepareTables(Synthesizer& synthesizer);

}  // namespace fluidtex::texture
