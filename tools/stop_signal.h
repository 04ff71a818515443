// Ctrl-C and SIGTERM.
#pragma once

#include <atomic>

namespace fluidtex::tools {

// From now on SIGINT and SIGTERM set the flag that is returned. Work that looks at it stops at a safe point;
// what does not within about half a second is ended where it is, with the sentence and the exit code of
// Interrupted. That loses nothing but what was being done: files get their names when they are whole
// (tools/atomic_file.h). A second signal ends the program at once.
const std::atomic<bool>& stopOnSignals();

}  // namespace fluidtex::tools
