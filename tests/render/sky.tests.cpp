#include "render/sky.h"
#include "render/sampling.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

TEST_CASE("sky: zenith, horizon and below have the colours asked for", "[render]") {
  Light light;
  light.skyColor = Vec3d(0.1, 0.2, 0.3);
  light.horizonColor = Vec3d(0.7, 0.8, 0.9);
  const Sky sky = makeSky(light);
  REQUIRE((sky.radiance(Vec3f(0, 0, 1)) - Vec3f(0.1f, 0.2f, 0.3f)).length() < 1e-6f);
  REQUIRE((sky.radiance(Vec3f(1, 0, 0)) - Vec3f(0.7f, 0.8f, 0.9f)).length() < 1e-6f);
  REQUIRE((sky.radiance(Vec3f(0.6f, 0, -0.8f)) - Vec3f(0.7f, 0.8f, 0.9f)).length() < 1e-6f);
}

TEST_CASE("sky: by default a white surface that faces the sun under the open sky has radiance 1",
          "[render]") {
  const Sky sky = makeSky(Light());
  const Axes axes(sky.sunDirection);
  constexpr int kSide = 100;
  double sum = luminance(sky.sunColor) / kPi;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      sum += luminance(
                 sky.radiance(axes.world(cosineHemisphere(Vec2f((i + 0.5f) / kSide, (j + 0.5f) / kSide))))) /
             (kSide * kSide);
  REQUIRE(sum == Approx(1.0).margin(0.15));
}

TEST_CASE("sky: the sun's radiance over its disc is the irradiance asked for", "[render]") {
  Light light;
  light.sunSize = 6.0;
  const Sky sky = makeSky(light);
  REQUIRE(sky.sunRadiance[0] / sky.sunPdf == Approx(light.sunColor[0]).epsilon(1e-4));
  const Axes axes(sky.sunDirection);
  const auto atDegrees = [&](float degrees) {
    const float a = degrees * kPi / 180.0f;
    return axes.world(Vec3f(std::sin(a), 0.0f, std::cos(a)));
  };
  REQUIRE(sky.inSun(atDegrees(2.9f)));
  REQUIRE_FALSE(sky.inSun(atDegrees(3.1f)));
}

TEST_CASE("sky: a sun without direction is refused", "[render]") {
  Light light;
  light.sunDirection = Vec3d(0.0);
  REQUIRE_THROWS_AS(makeSky(light), std::invalid_argument);
}
