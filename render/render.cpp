#include "render/render.h"

#include "render/develop.h"
#include "render/path_tracer.h"
#include "render/smooth_light.h"

#include <utility>

namespace fluidtex::render {
namespace {

Picture pictureOf(int width, int height, const std::vector<Vec3f>& radiance) {
  Picture picture{width, height, {}};
  picture.rgb.reserve(3 * radiance.size());
  for (const Vec3f& value : radiance) picture.rgb.insert(picture.rgb.end(), {value[0], value[1], value[2]});
  return picture;
}

}  // namespace

void develop(Picture& picture, double exposure) {
  for (float& value : picture.rgb) value = developed(value, exposure);
}

Picture render(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
               const Options& options, const View& view, const std::function<void(double)>& progress) {
  Layers layers = traceLayers(surface, solids, options, view, progress);
  Picture picture =
      pictureOf(options.width, options.height,
                options.smooth ? smoothedRadiance(std::move(layers)) : std::move(layers.radiance));
  develop(picture, options.exposure);
  return picture;
}

}  // namespace fluidtex::render
