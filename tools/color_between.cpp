#include "tools/color_between.h"

#include "texture/read_image.h"

namespace fluidtex::tools {

std::optional<texture::Detail> detailOf(const scenes::Scene& scene) {
  const texture::Options& texture = scene.texture;
  const texture::ExemplarOptions& exemplar = texture.exemplar;
  if (exemplar.between == texture::Between::points ||
      texture.synthesis.method != texture::Method::coordinates ||
      texture.laterFrames == texture::LaterFrames::advect)
    return std::nullopt;
  const bool own = exemplar.between == texture::Between::exemplar;
  return texture::makeDetail(texture::readImage(own ? exemplar.file : exemplar.betweenFile),
                             exemplar.toroidal);
}

render::ColorBetween colorBetween(const std::optional<texture::Detail>& detail,
                                  const texture::TexturedSurface& surface) {
  if (!detail) return {};
  return [&](std::uint32_t triangle, const texture::Vec3f& weights) {
    return texture::colorBetween(*detail, surface, triangle, weights);
  };
}

}  // namespace fluidtex::tools
