// Search tables kept from run to run: what an exemplar costs before its first window is matched is paid once.
#pragma once

#include "texture/exemplar/kept.h"
#include "texture/search/search.h"

namespace fluidtex::texture {

// buildSearchTable(), or what an earlier call with the same pixels and settings has left in `folder`.
// `padded` of the result is empty.
SearchTable cachedSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar,
                              const CacheFolder& folder);

}  // namespace fluidtex::texture
