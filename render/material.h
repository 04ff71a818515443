// Reflection model: a matt (Lambertian) base or a clear liquid, and where the surface is wet, a clear glossy
// coat over it, which is the surface of a clear liquid too.
//
//   f(wo, wi) = coat(wo, wi) + (1 - F(wo)) (1 - F(wi)) / (1 - Fmean) * base / pi
//
// coat: microfacet reflection, GGX, Fresnel factor F by Schlick's approximation, both times `gloss`; of a
// clear liquid F is exact, and gloss 1. The base loses what the coat reflects, on the way in and on the way
// out. Fmean, the hemispherical mean of F, lets a white base under a smooth coat reflect exactly all light,
// so energy is conserved. Directions are in the local axes of the shading normal (+z) and point away from the
// surface. Base and coat are sampled each by itself.
#pragma once

#include "render/vec.h"

namespace fluidtex::render {

struct Material {
  Vec3f base{0.5f};         // linear reflectance, 0..1
  Vec3f emission{0.0f};     // linear radiance, alike in all directions
  float gloss = 0.0f;       // strength of the coat, 0: none
  float roughness = 0.05f;  // GGX alpha of the coat
  float index = 1.45f;      // of refraction, of the coat or the clear liquid: between water and varnish
  bool clear = false;       // instead of the base: light is refracted and goes on
};

// f(wo, wi) * cos(wi) of base or coat alone, and the density of its samples at wi. 0 unless both directions
// are above the surface.
struct Lobe {
  Vec3f value{0.0f};
  float pdf = 0.0f;
};

Lobe evaluateBase(const Material& material, const Vec3f& wo, const Vec3f& wi);
Lobe evaluateCoat(const Material& material, const Vec3f& wo, const Vec3f& wi);

// A direction and what evaluate*() says of it.
struct LobeSample {
  Vec3f wi;
  Lobe lobe;
};

LobeSample sampleBase(const Material& material, const Vec3f& wo, const Vec2f& u);
LobeSample sampleCoat(const Material& material, const Vec3f& wo, const Vec2f& u);

// Share of light that the coat reflects at this cosine, 0..1: F times gloss.
float coatFresnel(const Material& material, float cosine);

// A smooth boundary between two clear media, hit by light at `cosine`, 0..1, to its normal. `ratio`: index of
// the medium that the light comes from over that of the other.
struct Boundary {
  float reflected;    // share, 0..1, of unpolarised light (Fresnel); 1: total reflection
  float cosineAfter;  // of the refracted direction to the normal; 0 where all is reflected
};

Boundary boundaryAt(float cosine, float ratio);

// The direction behind a boundary, unit. direction: unit, against the unit normal.
Vec3f refracted(const Vec3f& direction, const Vec3f& normal, float ratio, const Boundary& boundary);

}  // namespace fluidtex::render
