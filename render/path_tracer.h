// Light transport: the radiance that reaches the camera through every pixel.
#pragma once

#include "render/layers.h"
#include "render/render.h"

namespace fluidtex::render {

// Sky and sun shine through options.bounces reflections between surfaces; pixels are means over a tent
// filter. A tile of 16 x 16 pixels gets up to options.samples paths a pixel, and no more once the root mean
// square of its standard error is estimated to be options.noise at most. Otherwise as render().
Layers traceLayers(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
                   const Options& options, const View& view,
                   const std::function<void(double)>& progress = {});

}  // namespace fluidtex::render
