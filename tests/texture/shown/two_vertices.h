// A small surface on which pictures are looked up.
#pragma once

#include "texture/surface.h"

namespace fluidtex::testing {

// Two vertices on an exemplar of 8 x 4 texels; the second one still shows a quarter of its former place.
inline texture::TexturedSurface twoVertices() {
  texture::TexturedSurface surface;
  surface.exemplarWidth = 8;
  surface.exemplarHeight = 4;
  surface.positions.resize(2);
  surface.coordinate = {{2.0f, 1.0f}, {5.5f, 2.0f}};
  surface.fading = texture::noFading(2);
  surface.fading.coordinate[1] = {2.0f, 1.0f};
  surface.fading.weight[1] = 0.25f;
  return surface;
}

}  // namespace fluidtex::testing
