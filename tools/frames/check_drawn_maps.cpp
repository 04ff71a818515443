#include "tools/frames/check_drawn_maps.h"

#include <fmt/core.h>

#include <string>

namespace fluidtex::tools {
namespace {

void check(const std::string& key, const std::string& name, const std::string& what, const std::string& right,
           const texture::Exemplar& exemplar) {
  const texture::ExemplarMap& map = exemplar.maps.at(name);
  if (map.holds == texture::MapHolds::values && map.image.channels != 1)
    throw texture::ExemplarError(
        fmt::format("{}: {} has {} channels, and {}; give {}.", key, name, map.image.channels, what, right));
}

}  // namespace

void checkDrawnMaps(const render::Options& options, const texture::Exemplar& exemplar) {
  if (options.bump.any())
    check("render.bump.map", options.bump.map, "a relief is made from one or from normals",
          "a grey picture, or holds = \"normals\" in its [[texture.map]]", exemplar);
  if (options.displacement.any())
    check("render.displacement.map", options.displacement.map, "the surface is moved by one",
          "a grey picture", exemplar);
  if (const render::LiquidMaterial& lava = options.material; lava.glows() && !lava.heat.empty())
    check("render.material.heat", lava.heat, "heat is one", "a grey picture", exemplar);
}

}  // namespace fluidtex::tools
