// Whether parts of much or of little contrast are shown.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <optional>

namespace fluidtex::texture {

// Squared gradient of an exemplar's luminance, as it is seen, averaged over 3 x 3 texels, over the mean of
// the whole: one channel. 1 everywhere where the exemplar is of one luminance. Edges are edges, whether it
// wraps or not. color: linear RGBA.
Image contrastOf(const Image& color);
// Mean of that over the texels that the vertices show, new surface's too, what fades in but not what fades
// out: 1 where all of the exemplar is shown alike, less where what has little contrast was chosen. Nothing
// without a surface.
std::optional<double> measureContrast(const TexturedSurface& surface, const Image& contrast);

}  // namespace fluidtex::texture
