// Memory that is freed stays with the process.
#pragma once

#include <malloc.h>

namespace fluidtex::tools {

// Every frame needs about as much as the one before it, in pieces of some megabytes, which malloc would hand
// back to the system each time: for surfaces of a million points a sixth of preparation was spent on having
// the same pages cleared again. To be called first of all.
inline void keepMemory() {
  constexpr int kNever = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kNever);
}

}  // namespace fluidtex::tools
