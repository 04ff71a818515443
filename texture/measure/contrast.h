// Whether the parts of the exemplar shown have its contrast.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Squared gradient of the luminance as seen, averaged over 3 x 3 texels, over its mean: one channel; 1
// everywhere if the luminance is constant. Not wrapped. color: linear RGBA.
Image contrastOf(const Image& color);
// Mean of `contrast` over the texels shown, on new surface too, without former coordinates: 1 if the whole
// exemplar is shown evenly, less if parts of little contrast were favoured. Nothing without a surface.
std::optional<double> measureContrast(const TexturedSurface& surface, const Image& contrast);

}  // namespace fluidtex::texture
