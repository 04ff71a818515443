// Handling of Ctrl-C and SIGTERM.
#pragma once

#include <atomic>
#include <string>

namespace fluidtex::tools {

// Makes SIGINT and SIGTERM set the returned flag. Work that polls it stops at a safe point. If none has after
// about half a second, the process ends where it is, with the sentence and exit code of Interrupted; only
// unfinished work is lost, as files get their names when complete (tools/base/atomic_file.h). A second signal
// ends the program at once. onward: as of Interrupted; the first call's holds.
const std::atomic<bool>& stopOnSignals(const std::string& onward = "--resume");

}  // namespace fluidtex::tools
