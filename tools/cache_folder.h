// Where the program keeps what it would otherwise compute anew on each run.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

// $XDG_CACHE_HOME/fluidtex, or ~/.cache/fluidtex where that is not set or no absolute name, as the XDG Base
// Directory Specification has it. Empty, for nothing is kept, where HOME is not set either.
std::filesystem::path cacheFolder();

}  // namespace fluidtex::tools
