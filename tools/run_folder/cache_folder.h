// Location of the cache between runs.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

// $XDG_CACHE_HOME/fluidtex, or ~/.cache/fluidtex if that is unset or not absolute, as in the XDG Base
// Directory Specification. Empty, for no cache, if HOME is unset too.
std::filesystem::path cacheFolder();

}  // namespace fluidtex::tools
