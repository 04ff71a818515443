#include "render/displace.h"

#include "render/bump.h"

#include <cstdint>
#include <stdexcept>

namespace fluidtex::render {

texture::TexturedSurface displaced(const texture::TexturedSurface& surface, const Bump& displacement) {
  const auto values = surface.maps.find(displacement.map);
  if (values == surface.maps.end())
    throw std::invalid_argument("the surface has no map \"" + displacement.map +
                                "\" of one number, by which it would be displaced");
  texture::TexturedSurface result;
  result.spacing = surface.spacing;
  result.scale = surface.scale;
  result.triangles = surface.triangles;
  result.color = surface.color;
  result.contact = surface.contact;
  result.velocity = surface.velocity;
  result.maps = surface.maps;
  result.vectors = surface.vectors;
  result.normals = bumpedNormals(surface, displacement);
  result.positions = surface.positions;
  for (std::size_t v = 0; v < result.positions.size(); ++v) {
    if (!surface.contact.empty() && surface.contact[v]) {
      result.normals[v] = surface.normals[v];
      continue;
    }
    const double away =
        displacement.height * surface.spacingAt(static_cast<std::uint32_t>(v)) * values->second[v];
    result.positions[v] += surface.normals[v] * static_cast<float>(away);
  }
  return result;
}

}  // namespace fluidtex::render
