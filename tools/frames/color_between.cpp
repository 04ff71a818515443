#include "tools/frames/color_between.h"

#include "texture/exemplar/read_image.h"
#include "tools/formats/exemplar_picture.h"

#include <fmt/core.h>

#include <cmath>

namespace fluidtex::tools {

texture::Joints jointsOf(const texture::Options& options, const texture::TexturedSurface& surface) {
  if (!looksUp(options)) return {};
  return texture::findJoints(surface, options.exemplar.toroidal);
}

std::optional<texture::Detail> detailOf(const texture::Options& options) {
  const texture::ExemplarOptions& exemplar = options.exemplar;
  if (exemplar.between == texture::Between::points || !looksUp(options)) return std::nullopt;
  if (exemplar.between == texture::Between::exemplar) {
    texture::Image own = texture::exemplarPicture(exemplar);
    const int width = own.width;
    return texture::makeDetail(std::move(own), exemplar.toroidal, width);
  }
  const texture::Image own = texture::readImage(exemplar.file);
  const int width = own.width, height = own.height;
  texture::Image finer = texture::readImage(exemplar.betweenFile);
  if (std::abs(double(finer.width) / width * height - finer.height) > 1.0)
    throw texture::ExemplarError(fmt::format(
        "{} has {} x {} pixels, and its exemplar {} {} x {}; the same picture has the same shape.",
        exemplar.betweenFile.string(), finer.width, finer.height, exemplar.file.string(), width, height));
  return texture::makeDetail(std::move(finer), exemplar.toroidal, texture::exemplarSide(exemplar, width));
}

texture::Detail detailOfFrame(const std::filesystem::path& out, int frame, bool toroidal) {
  texture::Image shown = texture::readImage(out / exemplarFile(frame));
  const int width = shown.width;
  return texture::makeDetail(std::move(shown), toroidal, width);
}

render::ColorBetween colorBetween(const std::optional<texture::Detail>& detail,
                                  const texture::TexturedSurface& surface, const texture::Joints& joints) {
  if (!detail) return {};
  return [&](std::uint32_t triangle, const texture::Vec3f& weights) {
    return texture::colorBetween(*detail, surface, joints, triangle, weights);
  };
}

render::View viewOfFrame(const scenes::Scene& scene, int frame, const std::optional<texture::Detail>& detail,
                         const texture::TexturedSurface& surface, const texture::Joints& joints) {
  render::View view;
  view.domainSize = scene.sim.size;
  view.domainOrigin = scene.domainOrigin;
  view.progress = scene.frames > 1 ? double(frame - 1) / (scene.frames - 1) : 0.0;
  view.frame = frame;
  view.frameRate = scene.sim.frameRate;
  view.colorBetween = colorBetween(detail, surface, joints);
  view.seeThrough = detail && detail->seeThrough;
  view.textured = scene.texture.synthesis.method != texture::Method::none;
  return view;
}

}  // namespace fluidtex::tools
