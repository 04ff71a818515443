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
  const auto add = [&](const LobeSample& sample) {
    if (sample.lobe.pdf > 0.0f) sum += sample.lobe.value[0] / sample.lobe.pdf;
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2f u((i + 0.5f) / side, (j + 0.5f) / side);
      add(sampleBase(material, wo, u));
      add(sampleCoat(material, wo, u));
    }
  return sum / (side * side);
}

// Base and coat together.
Vec3f both(const Material& material, const Vec3f& wo, const Vec3f& wi) {
  return evaluateBase(material, wo, wi).value + evaluateCoat(material, wo, wi).value;
}

}  // namespace

TEST_CASE("material: without a coat it is Lambert's", "[render]") {
  Material material;
  material.base = Vec3f(0.2f, 0.4f, 0.6f);
  const Lobe base = evaluateBase(material, direction(30), direction(60, 2.0f));
  REQUIRE(base.value[1] == Approx(0.4f * 0.5f / kPi));
  REQUIRE(base.pdf == Approx(0.5f / kPi));
  REQUIRE(evaluateCoat(material, direction(30), direction(60, 2.0f)).pdf == 0.0f);
}

TEST_CASE("material: light and viewer can be exchanged", "[render]") {
  for (const float roughness : {0.05f, 0.3f})
    for (const float a : {5.0f, 40.0f, 80.0f})
      for (const float b : {10.0f, 41.0f, 85.0f}) {
        const Vec3f wo = direction(a, 0.1f), wi = direction(b, 3.0f);
        const float there = both(wet(0.5f, roughness), wo, wi)[0] / wi[2];
        const float back = both(wet(0.5f, roughness), wi, wo)[0] / wo[2];
        REQUIRE(there == Approx(back).epsilon(1e-4));
      }
}

TEST_CASE("material: its densities integrate to one", "[render]") {
  // Over a grid in (cos, azimuth).
  constexpr float kRoughness = 0.2f;
  const auto integral = [](Lobe (*evaluate)(const Material&, const Vec3f&, const Vec3f&), float degrees) {
    constexpr int kSide = 600;
    double sum = 0.0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const float z = (i + 0.5f) / kSide, azimuth = 2.0f * kPi * (j + 0.5f) / kSide,
                    r = std::sqrt(1.0f - z * z);
        const Vec3f wi(r * std::cos(azimuth), r * std::sin(azimuth), z);
        sum += evaluate(wet(0.3f, kRoughness), direction(degrees), wi).pdf;
      }
    return sum * 2.0 * kPi / (kSide * kSide);
  };
  for (const float degrees : {0.0f, 30.0f, 60.0f}) {
    CHECK(integral(evaluateBase, degrees) == Approx(1.0).epsilon(1e-3));
    CHECK(integral(evaluateCoat, degrees) < 1.0);
    CHECK(integral(evaluateCoat, degrees) > 0.9);
  }
  // Facets that are steeper than 45 degrees send what comes from above below the surface.
  CHECK(integral(evaluateCoat, 0.0f) == Approx(1.0 / (1.0 + kRoughness * kRoughness)).epsilon(1e-3));
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
    const Vec3f wo = direction(0.8f * static_cast<float>(i));
    const Vec2f u(0.37f, 0.01f * static_cast<float>(i));
    const auto check = [&](const LobeSample& sample, const Lobe& again) {
      REQUIRE(sample.lobe.pdf == again.pdf);
      REQUIRE(sample.lobe.value == again.value);
      REQUIRE(sample.wi.length() == Approx(1.0f).margin(1e-4));
    };
    const LobeSample base = sampleBase(material, wo, u), coat = sampleCoat(material, wo, u);
    check(base, evaluateBase(material, wo, base.wi));
    check(coat, evaluateCoat(material, wo, coat.wi));
  }
}

TEST_CASE("material: nothing is scattered below the surface, and nothing by a clear liquid's base",
          "[render]") {
  for (const auto evaluate : {evaluateBase, evaluateCoat}) {
    REQUIRE(evaluate(wet(0.5f, 0.1f), direction(30), direction(120)).pdf == 0.0f);
    REQUIRE(evaluate(wet(0.5f, 0.1f), direction(120), direction(30)).pdf == 0.0f);
  }
  Material water = wet(0.5f, 0.1f);
  water.clear = true;
  REQUIRE(evaluateBase(water, direction(30), direction(30, 2.0f)).pdf == 0.0f);
  REQUIRE(evaluateCoat(water, direction(30), direction(30, 2.0f)).pdf > 0.0f);
}

TEST_CASE("boundary: Snell's and Fresnel's laws, and total reflection", "[render]") {
  constexpr float kWater = 1.333f;
  REQUIRE(boundaryAt(1.0f, 1.0f / kWater).reflected == Approx(std::pow(0.333 / 2.333, 2.0)));
  REQUIRE(boundaryAt(1.0f, kWater).reflected == Approx(std::pow(0.333 / 2.333, 2.0)));
  REQUIRE(boundaryAt(0.0f, 1.0f / kWater).reflected == Approx(1.0));
  for (const float degrees : {5.0f, 30.0f, 60.0f, 85.0f}) {
    const Vec3f down = -direction(degrees), normal(0.0f, 0.0f, 1.0f);
    const Boundary into = boundaryAt(-down[2], 1.0f / kWater);
    const Vec3f below = refracted(down, normal, 1.0f / kWater, into);
    const auto sine = [](const Vec3f& v) { return std::hypot(v[0], v[1]); };
    REQUIRE(sine(below) * kWater == Approx(sine(down)).margin(1e-5));
    REQUIRE(below[2] < 0.0f);
    // The way back is the same way, and reflects as much.
    const Boundary back = boundaryAt(-below[2], kWater);
    REQUIRE(back.reflected == Approx(into.reflected).margin(1e-4));
    REQUIRE((refracted(-below, -normal, kWater, back) + down).length() < 1e-4f);
  }
  // At Brewster's angle only light across the plane of incidence is reflected.
  const float brewster = std::atan(kWater) * 180.0f / kPi;
  const double across = (1.0 - kWater * kWater) / (1.0 + kWater * kWater);
  REQUIRE(boundaryAt(direction(brewster)[2], 1.0f / kWater).reflected == Approx(0.5 * across * across));
  const float critical = std::asin(1.0f / kWater) * 180.0f / kPi;
  REQUIRE(boundaryAt(direction(critical + 0.1f)[2], kWater).reflected == 1.0f);
  REQUIRE(boundaryAt(direction(critical - 0.1f)[2], kWater).reflected < 1.0f);
}
