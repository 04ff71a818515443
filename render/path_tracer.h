// Light transport: the radiance that reaches the camera through every pixel.
#pragma once

#include "render/render.h"

namespace fluidtex::render {

// Radiance, linear and without exposure, averaged over a tent filter around each pixel. Sky and sun shine
// through options.bounces reflections between surfaces. Otherwise as render().
Picture traceRadiance(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                      const Options& options, const View& view,
                      const std::function<void(double)>& progress = {});

}  // namespace fluidtex::render
