#include "tools/frames/check_relief.h"

#include <fmt/core.h>

namespace fluidtex::tools {

void checkRelief(const render::Bump& bump, const texture::Exemplar& exemplar) {
  if (!bump.any()) return;
  const texture::ExemplarMap& map = exemplar.maps.at(bump.map);
  if (map.holds == texture::MapHolds::values && map.image.channels != 1)
    throw texture::ExemplarError(fmt::format(
        "render.bump.map: {} has {} channels, and a relief is made from one or from normals; give a grey "
        "picture, or holds = \"normals\" in its [[texture.map]].",
        bump.map, map.image.channels));
}

}  // namespace fluidtex::tools
