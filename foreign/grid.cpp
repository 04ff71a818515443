#include "foreign/grid.h"

namespace fluidtex::foreign {

std::string readGrid(const std::filesystem::path& file, bool vectors) {
  std::string stream;
  ask(vectors ? Wanted::vectors : Wanted::floats, file, [&](std::string_view piece) { stream += piece; });
  return stream;
}

}  // namespace fluidtex::foreign
