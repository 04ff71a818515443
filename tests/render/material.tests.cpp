#include "render/material.h"
#include "render/sampling.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

Vec3f direction(float degrees, float azimuth = 0.3f) {
  const float a = degrees * kPi / 180.0f;
  return Vec3f(std::sin(a) * std::cos(azimuth), std::sin(a) * std::sin(azimuth), std::cos(a));
}

Material wet(float base, float roughness) {
  Material material;
  material.base = Vec3f(base);
  material.gloss = 1.0f;
  material.roughness = roughness;
  return material;
}

// Share of the light from direction wo that the material sends back: the integral of f cos.
double albedo(const Material& material, const Vec3f& wo, int side = 300) {
  double sum = 0.0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2f u((i + 0.5f) / side, (j + 0.5f) / side);
      // The lobe is picked by a coordinate that is spread evenly, too.
      const float choice = std::fmod((i * side + j) * 0.61803398875, 1.0);
      const MaterialSample s = sampleMaterial(material, wo, choice, u);
      if (s.scattering.pdf > 0.0f) sum += s.scattering.value[0] / s.scattering.pdf;
    }
  return sum / (side * side);
}

}  // namespace

TEST_CASE("material: without a coat it is Lambert's", "[render]") {
  Material material;
  material.base = Vec3f(0.2f, 0.4f, 0.6f);
  const Scattering s = evaluate(material, direction(30), direction(60, 2.0f));
  REQUIRE(s.value[1] == Approx(0.4f * 0.5f / kPi));
  REQUIRE(s.pdf == Approx(0.5f / kPi));
}

TEST_CASE("material: light and viewer can be exchanged", "[render]") {
  for (const float roughness : {0.05f, 0.3f})
    for (const float a : {5.0f, 40.0f, 80.0f})
      for (const float b : {10.0f, 41.0f, 85.0f}) {
        const Vec3f wo = direction(a, 0.1f), wi = direction(b, 3.0f);
        const float there = evaluate(wet(0.5f, roughness), wo, wi).value[0] / wi[2];
        const float back = evaluate(wet(0.5f, roughness), wi, wo).value[0] / wo[2];
        REQUIRE(there == Approx(back).epsilon(1e-4));
      }
}

TEST_CASE("material: its density integrates to one", "[render]") {
  // Over a grid in (cos, azimuth). Directions that a facet sends below the surface are missing at grazing
  // angles.
  for (const float degrees : {0.0f, 30.0f, 60.0f}) {
    const Material material = wet(0.3f, 0.2f);
    constexpr int kSide = 600;
    double sum = 0.0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const float z = (i + 0.5f) / kSide, azimuth = 2.0f * kPi * (j + 0.5f) / kSide,
                    r = std::sqrt(1.0f - z * z);
        sum += evaluate(material, direction(degrees), Vec3f(r * std::cos(azimuth), r * std::sin(azimuth), z))
                   .pdf;
      }
    sum *= 2.0 * kPi / (kSide * kSide);
    REQUIRE(sum == Approx(1.0).epsilon(0.01));
    REQUIRE(sum < 1.001);
  }
}

TEST_CASE("material: it never sends back more light than arrives", "[render]") {
  for (const float roughness : {0.01f, 0.05f, 0.3f, 1.0f})
    for (const float base : {0.0f, 0.5f, 1.0f})
      for (const float degrees : {0.0f, 45.0f, 75.0f, 88.0f}) {
        const double share = albedo(wet(base, roughness), direction(degrees));
        CAPTURE(roughness, base, degrees, share);
        REQUIRE(share < 1.002);
      }
}

TEST_CASE("material: a white base under a smooth coat loses nothing", "[render]") {
  for (const float degrees : {0.0f, 45.0f, 75.0f})
    REQUIRE(albedo(wet(1.0f, 0.01f), direction(degrees)) == Approx(1.0).epsilon(0.01));
}

TEST_CASE("material: a black base under a smooth coat mirrors by Fresnel's law", "[render]") {
  const double straight = albedo(wet(0.0f, 0.01f), direction(0.0f));
  REQUIRE(straight == Approx(std::pow(0.45 / 2.45, 2.0)).epsilon(0.01));  // ((n-1)/(n+1))^2, n = 1.45
  REQUIRE(albedo(wet(0.0f, 0.01f), direction(85.0f)) > 0.5);
}

TEST_CASE("material: samples agree with evaluation", "[render]") {
  const Material material = wet(0.4f, 0.1f);
  for (int i = 0; i < 100; ++i) {
    const Vec3f wo = direction(0.8f * i);
    const MaterialSample s = sampleMaterial(material, wo, i % 2 ? 0.0f : 0.99f, Vec2f(0.37f, 0.01f * i));
    const Scattering again = evaluate(material, wo, s.wi);
    REQUIRE(s.scattering.pdf == again.pdf);
    REQUIRE(s.scattering.value == again.value);
    REQUIRE(s.wi.length() == Approx(1.0f).margin(1e-4));
  }
}

TEST_CASE("material: nothing is scattered below the surface", "[render]") {
  REQUIRE(evaluate(wet(0.5f, 0.1f), direction(30), direction(120)).pdf == 0.0f);
  REQUIRE(evaluate(wet(0.5f, 0.1f), direction(120), direction(30)).pdf == 0.0f);
}
