// What the readers of this room throw.
#pragma once

#include <stdexcept>

namespace fluidtex::caches {

// One sentence: the file, what is wrong with it, and what would be right.
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace fluidtex::caches
