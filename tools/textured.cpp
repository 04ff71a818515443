#include "tools/textured.h"

#include "texture/frames/renewal.h"
#include "texture/shown/plain.h"

namespace fluidtex::tools {

using texture::LaterFrames;
using texture::Method;

namespace {

// Guidance by age means the surface's: texture that it has renewed does not make the surface younger.
void keepAge(const texture::Carried& carried, double seconds, texture::TexturedSurface& surface) {
  for (std::size_t v = 0; v < carried.age.size(); ++v)
    surface.age[v] = texture::believed(carried.trust[v]) ? carried.age[v] + float(seconds) : 0.0f;
}

}  // namespace

texture::TexturedSurface textured(const scenes::Scene& scene, texture::Synthesizer& synthesizer,
                                  texture::Surface surface, const texture::Carried& carried, int frame,
                                  texture::SynthesisStats& stats,
                                  const std::function<void(double)>& progress) {
  const double seconds = 1.0 / scene.sim.frameRate;
  const LaterFrames later = scene.texture.laterFrames;
  const bool byAge = scene.texture.guidance.by == texture::GuidanceBy::age;
  if (scene.texture.synthesis.method == Method::none) {
    stats = {};
    stats.renewed = 0.0;
    return texture::untextured(std::move(surface), carried);
  }
  if (later == LaterFrames::advect && !carried.empty()) {
    stats = {};
    stats.renewed = 0.0;
    texture::TexturedSurface result = texture::advected(std::move(surface), carried, seconds);
    result.exemplarWidth = synthesizer.exemplar.color.width;
    result.exemplarHeight = synthesizer.exemplar.color.height;
    return result;
  }
  if (later == LaterFrames::alone && !carried.empty()) {
    texture::TexturedSurface result =
        texture::synthesize(synthesizer, std::move(surface), {}, frame, seconds, stats, progress);
    result.trust = carried.trust;
    result.previousPosition = carried.previousPosition;
    if (byAge) keepAge(carried, seconds, result);
    return result;
  }
  texture::TexturedSurface result =
      texture::synthesize(synthesizer, std::move(surface), carried, frame, seconds, stats, progress);
  if (byAge) keepAge(carried, seconds, result);
  return result;
}

bool needsAllLevels(const scenes::Scene& scene, const texture::TexturedSurface& last) {
  const bool eachAlone =
      scene.texture.laterFrames == LaterFrames::alone && scene.texture.synthesis.method != Method::none;
  return last.empty() || eachAlone;
}

}  // namespace fluidtex::tools
