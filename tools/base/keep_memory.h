// Keeps freed memory in the process.
#pragma once

#include <malloc.h>

namespace fluidtex::tools {

// Each frame needs about the same memory as the last, in blocks of megabytes that malloc would return to the
// system: on surfaces of a million points, clearing the same pages again took a sixth of surface preparation.
// To be called first.
inline void keepMemory() {
  constexpr int kNever = -1;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kNever);
}

}  // namespace fluidtex::tools
