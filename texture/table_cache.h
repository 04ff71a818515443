// Search tables kept from run to run: what an exemplar costs before its first window is matched is paid once.
#pragma once

#include "texture/search.h"

#include <filesystem>

namespace fluidtex::texture {

// buildSearchTable(), or what an earlier call with the same pixels and settings has left in `folder`. A file
// is named by the hash of all that the table depends on, and ends in the hash of what is in it: one that is
// damaged, cut short or of another version is ignored and replaced. It is written under a temporary name and
// renamed. Above kCacheBytes the files that have not been used for longest are removed. A folder that cannot
// be written is no fault: nothing is kept then. An empty name: nothing is kept. `padded` of the result is
// empty.
SearchTable cachedSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar,
                              const std::filesystem::path& folder);

inline constexpr std::uintmax_t kCacheBytes = std::uintmax_t(2) << 30;

}  // namespace fluidtex::texture
