// Reflection model: a matt (Lambertian) base, and where the surface is wet, a clear glossy coat over it.
//
//   f(wo, wi) = coat(wo, wi) + (1 - F(wo)) (1 - F(wi)) / (1 - Fmean) * base / pi
//
// coat: microfacet reflection, GGX, Fresnel factor F by Schlick's approximation, both times `gloss`. The base
// loses what the coat reflects, on the way in and on the way out. Fmean, the hemispherical mean of F, lets a
// white base under a smooth coat reflect exactly all light, so energy is conserved. Directions are in the
// local axes of the shading normal (+z) and point away from the surface.
#pragma once

#include "render/vec.h"

namespace fluidtex::render {

struct Material {
  Vec3f base{0.5f};         // linear reflectance, 0..1
  float gloss = 0.0f;       // strength of the coat, 0: none
  float roughness = 0.05f;  // GGX alpha of the coat
};

// f(wo, wi) * cos(wi), and the pdf of sampleMaterial() at wi. Precondition: both directions are above the
// surface.
struct Scattering {
  Vec3f value{0.0f};
  float pdf = 0.0f;
};

Scattering evaluate(const Material& material, const Vec3f& wo, const Vec3f& wi);

// A sampled direction wi and its scattering; value 0 if wi is below the surface. `choice` selects coat or
// base, `u` the direction.
struct MaterialSample {
  Vec3f wi;
  Scattering scattering;
};

MaterialSample sampleMaterial(const Material& material, const Vec3f& wo, float choice, const Vec2f& u);

}  // namespace fluidtex::render
