// How light leaves a surface: a matt base, and over it, where the surface is wet, a clear glossy coat.
//
//   f(wo, wi) = coat(wo, wi) + (1 - F(wo)) (1 - F(wi)) / (1 - Fmean) * base / pi
//
// coat: microfacet reflection, GGX, Fresnel factor F by Schlick's approximation, both times `gloss`. What the
// coat reflects is missing from the base, on the way in and on the way out; Fmean, the mean of F over the
// hemisphere, makes a white base under a smooth coat return exactly all light. So no surface is ever brighter
// than what shines on it. All directions here are in the local axes of the shading normal (+z) and point away
// from the surface.
#pragma once

#include "render/vec.h"

namespace fluidtex::render {

struct Material {
  Vec3f base{0.5f};         // linear reflectance, 0..1
  float gloss = 0.0f;       // strength of the coat, 0: none
  float roughness = 0.05f;  // GGX alpha of the coat
};

// f(wo, wi) * cos(wi), and the density with which sampleMaterial() draws wi. Both directions above the
// surface.
struct Scattering {
  Vec3f value{0.0f};
  float pdf = 0.0f;
};

Scattering evaluate(const Material& material, const Vec3f& wo, const Vec3f& wi);

// A direction wi and its scattering; value 0 where the drawn direction is below the surface.
// `choice` picks coat or base, `u` the direction.
struct MaterialSample {
  Vec3f wi;
  Scattering scattering;
};

MaterialSample sampleMaterial(const Material& material, const Vec3f& wo, float choice, const Vec2f& u);

}  // namespace fluidtex::render
