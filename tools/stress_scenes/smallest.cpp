#include "tools/stress_scenes/smallest.h"

namespace fluidtex::stress {

SceneParts smallest(SceneParts parts, const std::function<bool(const SceneParts&)>& fails) {
  // The first holds what no scene can be without. From the end: bodies before settings.
  for (std::size_t n = parts.size(); n-- > 1;) {
    SceneParts rest = parts;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(n));
    if (fails(rest)) parts = std::move(rest);
  }
  return parts;
}

}  // namespace fluidtex::stress
