#include "render/sky.h"

#include <numbers>
#include <stdexcept>

namespace fluidtex::render {

Sky makeSky(const Light& light) {
  if (!(light.sunDirection.length() > 0.0)) throw std::invalid_argument("the sun has no direction");
  // A disc smaller than this is not resolved in single precision; its shadows are sharp to the eye already.
  constexpr double kSmallestSun = 0.1;
  const double radius = 0.5 * std::clamp(light.sunSize, kSmallestSun, 180.0) * std::numbers::pi / 180.0;
  const double solidAngle = 2.0 * std::numbers::pi * (1.0 - std::cos(radius));

  Sky sky;
  sky.zenith = Vec3f(light.skyColor);
  sky.horizon = Vec3f(light.horizonColor);
  sky.sunDirection = Vec3f(light.sunDirection / light.sunDirection.length());
  sky.sunColor = Vec3f(light.sunColor);
  sky.sunRadiance = Vec3f(light.sunColor / solidAngle);
  sky.sunCosine = static_cast<float>(std::cos(radius));
  sky.sunPdf = static_cast<float>(1.0 / solidAngle);
  return sky;
}

}  // namespace fluidtex::render
