// Contracts of the room's functions, which hold in release builds too.
#pragma once

#include <stdexcept>

namespace fluidtex::sim {

// Throws std::invalid_argument with that sentence where the caller has not kept a function's contract. (NaN
// keeps none: conditions are written so that it fails them.)
inline void require(bool kept, const char* sentence) {
  if (!kept) throw std::invalid_argument(sentence);
}

}  // namespace fluidtex::sim
