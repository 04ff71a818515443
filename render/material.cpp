// Based on: Walter et al., Microfacet models for refraction through rough surfaces, 2007 (GGX); Heitz,
// Sampling the GGX distribution of visible normals, JCGT 2018; Schlick, An inexpensive BRDF model, 1994;
// Ashikhmin and Shirley, An anisotropic Phong BRDF model, 2000 (the coupling of base and coat).
#include "render/material.h"

#include "render/sampling.h"

namespace fluidtex::render {
namespace {

// Reflectance at normal incidence.
float straightOn(const Material& material) {
  const float root = (material.index - 1.0f) / (material.index + 1.0f);
  return root * root;
}

float fresnel(float f0, float cosine) {
  const float m = 1.0f - cosine, m2 = m * m;
  return f0 + (1.0f - f0) * m2 * m2 * m;
}

// 2 * integral of F(mu) mu.
float fresnelMean(float f0) {
  return f0 + (1.0f - f0) / 21.0f;
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

}  // namespace

float coatFresnel(const Material& material, float cosine) {
  if (material.clear) return boundaryAt(cosine, 1.0f / material.index).reflected;
  return material.gloss > 0.0f ? material.gloss * fresnel(straightOn(material), cosine) : 0.0f;
}

Lobe evaluateBase(const Material& material, const Vec3f& wo, const Vec3f& wi) {
  if (wo[2] <= 0.0f || wi[2] <= 0.0f || material.clear) return {};
  const float pdf = wi[2] / kPi;
  if (material.gloss <= 0.0f) return {material.base * pdf, pdf};
  const float passed = (1.0f - coatFresnel(material, wo[2])) * (1.0f - coatFresnel(material, wi[2]));
  return {material.base * (passed / (1.0f - material.gloss * fresnelMean(straightOn(material))) * pdf), pdf};
}

Lobe evaluateCoat(const Material& material, const Vec3f& wo, const Vec3f& wi) {
  if (wo[2] <= 0.0f || wi[2] <= 0.0f || material.gloss <= 0.0f) return {};
  const Vec3f h = normalized(wo + wi);
  const float lo = lambda(wo[2], material.roughness), li = lambda(wi[2], material.roughness);
  const float facet = normalDensity(h[2], material.roughness) / (4.0f * wo[2]);
  // D G F / (4 cos cos) * cos(wi)
  const float value = coatFresnel(material, std::min(1.0f, wo.dot(h))) * facet / (1.0f + lo + li);
  return {Vec3f(value), facet / (1.0f + lo)};
}

LobeSample sampleBase(const Material& material, const Vec3f& wo, const Vec2f& u) {
  const Vec3f wi = cosineHemisphere(u);
  return {wi, evaluateBase(material, wo, wi)};
}

LobeSample sampleCoat(const Material& material, const Vec3f& wo, const Vec2f& u) {
  const Vec3f h = visibleNormal(wo, material.roughness, u);
  const Vec3f wi = h * (2.0f * wo.dot(h)) - wo;
  return {wi, evaluateCoat(material, wo, wi)};
}

Boundary boundaryAt(float cosine, float ratio) {
  const float sineAfter2 = ratio * ratio * std::max(0.0f, 1.0f - cosine * cosine);
  if (sineAfter2 >= 1.0f) return {1.0f, 0.0f};
  const float after = std::sqrt(1.0f - sineAfter2);
  const float across = (ratio * cosine - after) / (ratio * cosine + after);
  const float along = (cosine - ratio * after) / (cosine + ratio * after);
  return {0.5f * (across * across + along * along), after};
}

Vec3f refracted(const Vec3f& direction, const Vec3f& normal, float ratio, const Boundary& boundary) {
  const float cosine = -direction.dot(normal);
  return normalized(direction * ratio + normal * (ratio * cosine - boundary.cosineAfter));
}

}  // namespace fluidtex::render
