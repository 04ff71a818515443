// Light sources: a sky that brightens towards the horizon, and a sun of finite angular size.
#pragma once

#include "render/options.h"
#include "render/vec.h"

namespace fluidtex::render {

struct Sky {
  Vec3f zenith, horizon;
  Vec3f sunDirection;  // unit, towards the centre of the disc
  Vec3f sunColor;      // irradiance on a plane that faces the sun
  Vec3f sunRadiance;   // of the disc
  float sunCosine;     // of its angular radius
  float sunPdf;        // 1 / solid angle of the disc

  // Radiance from `direction`, without the sun's disc. Below the horizon: the horizon's colour.
  Vec3f radiance(const Vec3f& direction) const {
    // The gradient is steep at the horizon and flat at the zenith, as that of a clear sky is.
    const float below = 1.0f - std::clamp(direction[2], 0.0f, 1.0f);
    return mix(zenith, horizon, below * below * below);
  }

  bool inSun(const Vec3f& direction) const { return direction.dot(sunDirection) >= sunCosine; }
};

// Throws std::invalid_argument if the sun's direction is zero.
Sky makeSky(const Light& light);

}  // namespace fluidtex::render
