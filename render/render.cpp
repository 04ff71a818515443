#include "render/render.h"

#include "render/path_tracer.h"

#include <cmath>

namespace fluidtex::render {
namespace {

// Up to the knee a value stays as it is, so that colours are true; above it, everything up to infinity is
// bent smoothly into what is left below 1, so that highlights do not burn out.
constexpr float kKnee = 0.8f;

float developed(float radiance, float exposure) {
  const float x = radiance * exposure;
  if (!(x > kKnee)) return std::isfinite(x) ? x : 0.0f;
  return kKnee + (1.0f - kKnee) * (1.0f - std::exp(-(x - kKnee) / (1.0f - kKnee)));
}

}  // namespace

void develop(Picture& picture, double exposure) {
  for (float& value : picture.rgb) value = developed(value, static_cast<float>(exposure));
}

Picture render(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
               const Options& options, const View& view, const std::function<void(double)>& progress) {
  Picture picture = traceRadiance(surface, solids, options, view, progress);
  develop(picture, options.exposure);
  return picture;
}

}  // namespace fluidtex::render
