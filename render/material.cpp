// Based on: Walter et al., Microfacet models for refraction through rough surfaces, 2007 (GGX); Heitz,
// Sampling the GGX distribution of visible normals, JCGT 2018; Schlick, An inexpensive BRDF model, 1994;
// Ashikhmin and Shirley, An anisotropic Phong BRDF model, 2000 (the coupling of base and coat).
#include "render/material.h"

#include "render/sampling.h"

namespace fluidtex::render {
namespace {

// Reflectance at normal incidence of a clear film of index 1.45, between water and varnish.
constexpr float kF0 = 0.0337f;
constexpr float kFMean = kF0 + (1.0f - kF0) / 21.0f;  // 2 * integral of F(mu) mu

float fresnel(float cosine) {
  const float m = 1.0f - cosine, m2 = m * m;
  return kF0 + (1.0f - kF0) * m2 * m2 * m;
}

// GGX: density of normals, and Smith's lambda of the masking term.
float normalDensity(float cosine, float alpha) {
  const float a2 = alpha * alpha, d = cosine * cosine * (a2 - 1.0f) + 1.0f;
  return a2 / (kPi * d * d);
}

float lambda(float cosine, float alpha) {
  const float c2 = cosine * cosine;
  return 0.5f * (std::sqrt(1.0f + alpha * alpha * (1.0f - c2) / c2) - 1.0f);
}

// A facet normal as seen from wo, in the density D G1 max(0, wo.h) / wo.z.
Vec3f visibleNormal(const Vec3f& wo, float alpha, const Vec2f& u) {
  const Vec3f v = normalized(Vec3f(alpha * wo[0], alpha * wo[1], wo[2]));
  const float r = std::sqrt(u[0]), angle = 2.0f * kPi * u[1];
  // The disc's axes: first tangent level, second pointing up the slope.
  const float flat = v[0] * v[0] + v[1] * v[1];
  const Vec3f t1 =
      flat > 1e-12f ? Vec3f(-v[1], v[0], 0.0f) * (1.0f / std::sqrt(flat)) : Vec3f(1.0f, 0.0f, 0.0f);
  const Vec3f t2 = v.cross(t1);
  const float p1 = r * std::cos(angle), s = 0.5f * (1.0f + v[2]);
  const float p2 = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p1 * p1)) + s * r * std::sin(angle);
  const Vec3f n = t1 * p1 + t2 * p2 + v * std::sqrt(std::max(0.0f, 1.0f - p1 * p1 - p2 * p2));
  return normalized(Vec3f(alpha * n[0], alpha * n[1], std::max(1e-6f, n[2])));
}

// Share of the drawn directions that go to the coat: near its share of the reflected light, but never so few
// that a single mirrored ray weighs heavily.
float coatShare(const Material& material, float reflected) {
  if (material.gloss <= 0.0f) return 0.0f;
  constexpr float kLeast = 0.15f;
  const float base = (1.0f - reflected) * luminance(material.base);
  return std::clamp(reflected / (reflected + base + 1e-6f), kLeast, 0.9f);
}

}  // namespace

Scattering evaluate(const Material& material, const Vec3f& wo, const Vec3f& wi) {
  if (wo[2] <= 0.0f || wi[2] <= 0.0f) return {};
  const float cosinePdf = wi[2] / kPi;
  if (material.gloss <= 0.0f) return {material.base * cosinePdf, cosinePdf};

  const float fo = material.gloss * fresnel(wo[2]), fi = material.gloss * fresnel(wi[2]);
  const float share = coatShare(material, fo);
  const Vec3f h = normalized(wo + wi);
  const float density = normalDensity(h[2], material.roughness);
  const float lo = lambda(wo[2], material.roughness), li = lambda(wi[2], material.roughness);
  const float facet = density / (4.0f * wo[2]);
  // D G F / (4 cos cos) * cos(wi)
  const float coat = material.gloss * fresnel(std::min(1.0f, wo.dot(h))) * facet / (1.0f + lo + li);
  const float base = (1.0f - fo) * (1.0f - fi) / (1.0f - material.gloss * kFMean) * cosinePdf;

  Scattering result;
  result.value = material.base * base + Vec3f(coat);
  result.pdf = share * facet / (1.0f + lo) + (1.0f - share) * cosinePdf;
  return result;
}

MaterialSample sampleMaterial(const Material& material, const Vec3f& wo, float choice, const Vec2f& u) {
  MaterialSample sample;
  const float share = coatShare(material, material.gloss > 0.0f ? material.gloss * fresnel(wo[2]) : 0.0f);
  if (choice < share) {
    const Vec3f h = visibleNormal(wo, material.roughness, u);
    sample.wi = h * (2.0f * wo.dot(h)) - wo;
  } else {
    sample.wi = cosineHemisphere(u);
  }
  sample.scattering = evaluate(material, wo, sample.wi);
  return sample;
}

}  // namespace fluidtex::render
