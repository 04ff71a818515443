// Search tables kept between runs, so that they are built once per exemplar.
#pragma once

#include "texture/exemplar/kept.h"
#include "texture/search/search.h"

namespace fluidtex::texture {

// buildSearchTable(), or its result of an earlier call with the same pixels and settings, from `folder`.
// `padded` of the result is empty.
SearchTable cachedSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar,
                              const CacheFolder& folder);

}  // namespace fluidtex::texture
