#include "tools/frames/start_note.h"

#include <fmt/core.h>

#include <numeric>

namespace fluidtex::tools {

StartNote startNote(const scenes::Start& start, const texture::TexturedSurface& first) {
  const std::string mesh = start.mesh.file.filename().string();
  const auto count = std::accumulate(first.original.begin(), first.original.end(), std::size_t(0));
  if (count == 0)
    return {
        fmt::format("texture.start: no part of the first surface lies within about a cell of {} and faces "
                    "as it does, so nothing begins with its texture",
                    mesh),
        true};
  return {fmt::format("texture: {:.0f}% of the first surface begin with that of {}",
                      100.0 * double(count) / double(first.original.size()), mesh)};
}

}  // namespace fluidtex::tools
